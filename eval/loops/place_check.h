#pragma once
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/graph/map.h>

namespace placegraph {

struct PlaceCheckOptions {
  double max_distance_m = 15;  ///< largest distance between two views of one place [m]
  double max_angle_deg = 45;   ///< largest angle between their viewing directions [deg]
  RevisitOptions revisit;      ///< criteria for a revisit
  void check() const;
};
void visit(OptionVisitor& field, PlaceCheckOptions& options);

/// The places of a map, compared with the ground truth.
struct PlaceCheck {
  int places = 0;
  /// Pairs of views (keyframes) of one place, and those within the limits by the true poses.
  std::int64_t pairs = 0, pure_pairs = 0;
  /// Places that revisiting frames observe again, and places that have revisiting frames only.
  int revisited_places = 0, added_places = 0;
  /// Unordered pairs of places with a direct transition of the camera, in the map and in the truth.
  /// In the truth every frame belongs to the nearest anchor keyframe with a similar viewing
  /// direction. `common` pairs are in both; a transition that skips a place which is truly in
  /// between counts for neither precision nor recall.
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

/// Compares the places of a map with the ground truth.
/// `truth` has one pose per frame of the sequence, indexed by the map's frame numbers; frames
/// without one are left out. Throws ArgumentError for frame numbers beyond the truth.
PlaceCheck check_places(const Map& map, const Trajectory& truth,
                        const PlaceCheckOptions& options = {});

}  // namespace placegraph
