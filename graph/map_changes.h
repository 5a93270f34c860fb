#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/place_history.h>

namespace [[gnu::visibility("default")]] placegraph {

/// What a map in the making has gained, and what has changed in it, since it was last asked.
struct MapChanges {
  /// A constraint of the place graph that is new, has changed, or (without value) is gone. Keys
  /// order the constraints and last for as long as they exist.
  struct ConstraintChange {
    int kind = 0;
    std::int64_t number = 0;
    std::optional<RelativePoseConstraint> constraint;
  };

  std::vector<Place> places;  ///< all, with their members, without appearances
  std::vector<std::pair<PlaceId, Appearance>> appearances;  ///< new or changed, by place
  std::vector<ConstraintChange> constraints;
  /// New, or their features have changed; their view is empty where it has not. The places of the
  /// others stand in `places`.
  std::vector<Keyframe> keyframes;
  std::size_t first_frame = 0;  ///< frames and poses online before it are as they were
  std::vector<FrameRecord> frames;
  std::vector<StampedPose> online;
  std::size_t first_landmark = 0;  ///< as above
  std::vector<PointLandmark> landmarks;
  std::vector<LoopRecord> loops;  ///< all
  PlaceHistory history;           ///< the whole
  bool metric = false;
};

}  // namespace placegraph
