#pragma once
#include <placegraph/eval/loops/same_view.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/place_graph.h>

#include <map>

namespace placegraph {

struct RouteCheckOptions {
  SameView same;        ///< criteria for frames of different passes on the same road
  int max_pairs = 500;  ///< maximum number of pairs of places, spread evenly over all pairs
  void check() const;   ///< throws ArgumentError naming the field
};
void visit(OptionVisitor& field, RouteCheckOptions& options);

/// Shortest routes over the places of a map, compared with those of the truth.
struct RouteCheck {
  int pairs = 0;        ///< pairs that the map connects
  int apart = 0;        ///< pairs that the map does not connect
  int same_places = 0;  ///< routes over the same places as the shortest route by the true poses
  /// True length of the map's route over that of the shortest route over the same roads, minus one.
  /// It is small for two routes of nearly equal length, even over different places.
  double worst_excess = 0;
  /// The same relative to the shortest route along the driven path (`driven_roads`), which has
  /// roads that the map may lack: the map connects two passes where they met, not where they
  /// parted.
  double median_detour = 0, worst_detour = 0;
  int within_5_percent = 0;   ///< pairs with a detour of at most 5 %
  double worst_detour_m = 0;  ///< the longest detour [m]
  /// |length in the map / true length of the same route - 1|; 0 for routes of length zero.
  double median_length_error = 0, worst_length_error = 0;
};

/// The road network that was driven.
/// Every frame is a place, connected to the next one and to the nearest frame of every other pass
/// within reach that has a similar viewing direction. Frames without ground truth are left out.
PlaceGraph driven_roads(const Trajectory& truth, const RouteCheckOptions& options);

/// Compares the shortest routes of a map with those of the truth.
/// `frame_of_place`: the line of `truth` of a place's anchor keyframe. The length errors are
/// meaningful only for a metric map. Throws ArgumentError for places without a true pose.
RouteCheck check_routes(const PlaceGraph& graph, const std::map<PlaceId, FrameId>& frame_of_place,
                        const Trajectory& truth, const RouteCheckOptions& options = {});

}  // namespace placegraph
