#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/tracking/frame_result.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe that was added to the map.
struct KeyframeAdded {
  KeyframeId keyframe;  ///< id of the keyframe; ids ascend
  FrameId frame;        ///< the frame that became the keyframe
  PlaceId place;        ///< place to which the keyframe belongs
  SE3 T_map_cam;        ///< current estimate of the keyframe's pose
};

/// A place that was added to the map.
struct PlaceAdded {
  PlaceId place;      ///< id of the place
  KeyframeId anchor;  ///< keyframe whose coordinate frame is that of the place
  SE3 T_map_place;    ///< current estimate of the place's pose
  int component = 0;  ///< component to which the place belongs
};

/// Two places that were merged.
struct PlacesMerged {
  PlaceId kept;  ///< place that now contains the keyframes of both
  PlaceId gone;  ///< younger place, which no longer exists
};

/// The present pose of a place.
struct PlacePose {
  PlaceId place;     ///< id of the place
  Sim3 S_map_place;  ///< current estimate; its scale: lengths in the map over lengths at the place
};

/// Change of the poses of places, after which earlier snapshots are out of date.
struct MapMoved {
  /// Factor applied to all lengths of the newest track segment because its scale has become known;
  /// 1: the scale has not changed.
  double scale = 1;
  int places = 0;           ///< number of places that have moved
  double translation = 0;   ///< largest translation of a place [m, or in the scale of the map]
  double rotation_rad = 0;  ///< largest rotation of a place
  std::vector<PlacePose> poses = {};  ///< new poses of the places that have moved, by id
};

/// A component of the map that was joined to another one.
struct ComponentJoined {
  int component = 0;  ///< component that no longer exists
  int into = 0;       ///< component to which its places now belong
};

/// The lens distortion for which run_sequence begins again with undistorted images.
struct LensFound {
  FrameId frame;        ///< frame after which it was clear
  double k1 = 0;        ///< first radial coefficient of OpenCV's model, over all passes
  double sigma_k1 = 0;  ///< standard deviation of k1
  int pass = 0;         ///< pass that begins now, from 2 on
};

/// Listener for events during mapping.
///
/// Derive from this class, override the functions of interest and pass the object to Slam
/// (SlamInputs::events). Slam calls it from within add_frame, resume and finish, on the thread of
/// their caller. The order within add_frame is fixed:
///
///   map_moved, if the scale of the map has become known
///   for each new keyframe, oldest first
///     keyframe_added
///     place_added, places_merged, component_joined, map_moved caused by the keyframe
///     loop_refused, loop_accepted, in the order in which the candidates were found
///     place_added, places_merged, component_joined, map_moved caused by accepted loops
///   frame_posed or frame_lost, once for every frame
///
/// Events of one kind come in ascending order of ids. finish reports the effects of its
/// optimization. resume does not report the contents of the saved map, but it reports keyframes
/// that arise when the last frame is processed again; later events may refer to places and
/// keyframes of the saved map. The number of a component that was joined to another may be reused
/// for a later one.
///
/// The arguments are valid at least until the call returns. A function must not call the Slam
/// object that called it. An exception from a function propagates through add_frame, resume or
/// finish, and the Slam object must not be used afterwards. A listener costs time in proportion to
/// the number of places at each new place and each accepted loop.
class SlamEvents {
 public:
  virtual ~SlamEvents() = default;

  /// Called by run_sequence when a run begins; earlier events refer to another map.
  virtual void run_began() {}
  /// Called by run_sequence when images proved to be distorted; run_began follows.
  virtual void lens_found(const LensFound& lens) { static_cast<void>(lens); }
  /// Called when a frame has a pose.
  virtual void frame_posed(const FrameResult& frame) { static_cast<void>(frame); }
  /// Called when a frame has no pose (yet), see FrameResult::outcome.
  virtual void frame_lost(const FrameResult& frame) { static_cast<void>(frame); }
  /// Called when a frame became a keyframe of the map.
  virtual void keyframe_added(const KeyframeAdded& keyframe) { static_cast<void>(keyframe); }
  /// Called when a loop candidate passed all tests; the map is optimized with it right after.
  virtual void loop_accepted(const LoopRecord& loop) { static_cast<void>(loop); }
  /// Called when a loop candidate failed the test LoopRecord::stage.
  ///
  /// A candidate that waits for the support of a second loop (LoopStage::kSupport) may still be
  /// accepted with a later keyframe.
  virtual void loop_refused(const LoopRecord& loop) { static_cast<void>(loop); }
  /// Called when a keyframe founded a place, or when a merger was undone.
  ///
  /// A merger is undone if odometry contradicts it.
  virtual void place_added(const PlaceAdded& place) { static_cast<void>(place); }
  /// Called when two places were merged.
  virtual void places_merged(const PlacesMerged& places) { static_cast<void>(places); }
  /// Called when two components were joined.
  virtual void component_joined(const ComponentJoined& component) { static_cast<void>(component); }
  /// Called when an optimization moved places, or when the scale has become known.
  virtual void map_moved(const MapMoved& move) { static_cast<void>(move); }
};

}  // namespace placegraph
