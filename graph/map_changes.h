#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/place_history.h>

namespace [[gnu::visibility("default")]] placegraph {

/// What has been added to a map under construction, or changed in it, since the last call.
struct MapChanges {
  /// A constraint of the place graph that is new, has changed or, without a value, is gone.
  /// (kind, number) identifies it for as long as it exists and orders the constraints.
  struct ConstraintChange {
    int kind = 0;                                      ///< first part of its key
    std::int64_t number = 0;                           ///< second part of its key
    std::optional<RelativePoseConstraint> constraint;  ///< as it is now; nothing: it is gone
  };

  std::vector<Place> places;  ///< all of the map, with their members, without appearances
  std::vector<std::pair<PlaceId, Appearance>> appearances;  ///< new or changed ones
  std::vector<ConstraintChange> constraints;                ///< new, changed or removed ones
  /// Those that are new or whose features have changed; their view is empty if it has not changed.
  /// The places of all others stand in `places`.
  std::vector<Keyframe> keyframes;
  std::size_t first_frame = 0;      ///< frames and online poses before this position are unchanged
  std::vector<FrameRecord> frames;  ///< from `first_frame` on
  std::vector<StampedPose> online;  ///< T_map_cam from `first_frame` on
  std::size_t first_landmark = 0;   ///< landmarks before this position are unchanged
  std::vector<PointLandmark> landmarks;  ///< from `first_landmark` on
  std::vector<LoopRecord> loops;         ///< all of the map
  PlaceHistory history;                  ///< all of the map
  bool metric = false;                   ///< whether the map's unit of length is the metre now
};

}  // namespace placegraph
