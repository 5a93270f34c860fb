#pragma once
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/graph/map.h>

namespace placegraph {

struct PlaceCheckOptions {
  double max_distance_m = 15;  ///< between two views of one place
  double max_angle_deg = 45;   ///< between where they look
  RevisitOptions revisit;      ///< what counts as having been there before
  void check() const;
};
void visit(OptionVisitor& field, PlaceCheckOptions& options);

/// The places of a map against the truth.
struct PlaceCheck {
  int places = 0;
  /// Pairs of views (keyframes) of one place, and those truly as near as asked.
  std::int64_t pairs = 0, pure_pairs = 0;
  /// Places seen again on revisiting frames as they were founded before, and places that only
  /// revisiting frames know.
  int revisited_places = 0, added_places = 0;
  /// Unordered pairs of places that the camera went between, in the map and in the truth: there
  /// every frame stands in the place whose anchor is truly nearest among those that look the same
  /// way. `common` are in both; a way that skips one place truly between is in neither's favour.
  int adjacent = 0, true_adjacent = 0, common = 0;

  double purity() const { return pairs ? static_cast<double>(pure_pairs) / pairs : 1; }
  double growth() const {
    return revisited_places ? static_cast<double>(added_places) / revisited_places : 0;
  }
  double adjacency_precision() const {
    return adjacent ? static_cast<double>(common) / adjacent : 1;
  }
  double adjacency_recall() const {
    return true_adjacent ? static_cast<double>(common) / true_adjacent : 1;
  }
};

/// `truth` has one pose per frame of the sequence, indexed by the map's frame numbers; frames
/// without one are left out. Throws ArgumentError for frame numbers beyond the truth.
PlaceCheck check_places(const Map& map, const Trajectory& truth,
                        const PlaceCheckOptions& options = {});

}  // namespace placegraph
