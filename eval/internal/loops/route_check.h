#pragma once
#include <placegraph/eval/loops/same_view.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/place_graph.h>

#include <map>

namespace placegraph {

struct RouteCheckOptions {
  SameView same;        ///< frames of different passes for which it holds stand on one road
  int max_pairs = 500;  ///< pairs of places that are asked for, spread evenly over all
  void check() const;   ///< throws ArgumentError naming the field
};
void visit(OptionVisitor& field, RouteCheckOptions& options);

/// Shortest ways over the places of a map against those of the truth.
struct RouteCheck {
  int pairs = 0;        ///< that the map joins
  int apart = 0;        ///< that it does not
  int same_places = 0;  ///< ways over the very places that are shortest by the true poses too
  /// True length of the map's way over that of the shortest over the same roads, less one: what
  /// going by the map costs. Where two ways are nearly as long, it is small though places differ.
  double worst_excess = 0;
  /// Likewise over the shortest way along what was driven (`driven_roads`), which also knows
  /// roads that the map misses: the map joins two passes where they met, not where they parted.
  double median_detour = 0, worst_detour = 0;
  int within_5_percent = 0;   ///< pairs whose detour is no longer than that
  double worst_detour_m = 0;  ///< the longest of them, as a length
  /// |length in the map / true length of the same way - 1|; 0 of ways without length.
  double median_length_error = 0, worst_length_error = 0;
};

/// The road network that was driven: every frame is a place, joined to the next one and to the
/// nearest of every other pass within reach that looks the same way. Frames without truth are left
/// out.
PlaceGraph driven_roads(const Trajectory& truth, const RouteCheckOptions& options);

/// `frame_of_place`: the line of `truth` that a place's anchor was seen at. The map must be metric
/// for the length errors to mean anything. Throws ArgumentError for places without a true pose.
RouteCheck check_routes(const PlaceGraph& graph, const std::map<PlaceId, FrameId>& frame_of_place,
                        const Trajectory& truth, const RouteCheckOptions& options = {});

}  // namespace placegraph
