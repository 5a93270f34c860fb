#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/slam/frame_result.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe that was added to the map.
struct KeyframeAdded {
  KeyframeId keyframe;  ///< its id; ids ascend
  FrameId frame;        ///< the frame that became the keyframe
  PlaceId place;        ///< the place that it belongs to
  SE3 T_map_cam;        ///< the keyframe's pose as it is known now
};

/// A place that was added to the map.
struct PlaceAdded {
  PlaceId place;      ///< its id
  KeyframeId anchor;  ///< the keyframe whose frame is that of the place
  SE3 T_map_place;    ///< its pose as it is known now
  int component = 0;  ///< the sub-map that it belongs to
};

/// Two places that were found to be one.
struct PlacesMerged {
  PlaceId kept;  ///< the place, which now holds the keyframes of both
  PlaceId gone;  ///< the younger place, which is no place any more
};

/// Poses of places that have changed: snapshots before this event are out of date.
struct MapMoved {
  /// By which all lengths of the newest track segment were multiplied because its unit has become
  /// known; 1: no unit has changed.
  double scale = 1;
  int places = 0;           ///< how many places have moved
  double translation = 0;   ///< the longest translation of a place [m, or the map's unit]
  double rotation_rad = 0;  ///< the largest rotation of a place
};

/// A sub-map that was joined to another one.
struct ComponentJoined {
  int component = 0;  ///< the sub-map that is no longer one of its own
  int into = 0;       ///< the sub-map that its places belong to now
};

/// What happens while a map is made, as it happens.
///
/// Derive from this, override what is of interest and hand the object to Slam (SlamInputs::events).
/// Slam calls it from within add_frame, resume and finish, on the thread of their caller. The order
/// within add_frame is fixed:
///
///   map_moved, where the map's unit of length has become known
///   for each new keyframe, oldest first
///     keyframe_added
///     place_added, places_merged, component_joined, map_moved that the keyframe has caused
///     loop_refused, loop_accepted, in the order in which the candidates were found
///     place_added, places_merged, component_joined, map_moved that accepted loops have caused
///   frame_posed or frame_lost, once for every frame
///
/// Of one kind they come in ascending order of ids. finish tells what its optimization has led to.
/// resume takes what the saved map holds as known, and tells of keyframes that its last frame, seen
/// again, has made; later events may name places and keyframes of the saved map. The number of a
/// sub-map that was joined to another may be given to a later one.
///
/// The arguments are values of their own or last until the call returns. A function must not call
/// the Slam object that called it; what it throws is thrown by add_frame, resume or finish, after
/// which the Slam object must not be used any more. A listener costs time in proportion to the
/// number of places at each new place and each accepted loop.
class SlamEvents {
 public:
  virtual ~SlamEvents() = default;

  /// A run begins: what was told before belongs to another map. Called by run_sequence alone.
  virtual void run_began() {}
  /// A frame was given a pose.
  virtual void frame_posed(const FrameResult& frame) { static_cast<void>(frame); }
  /// A frame has no pose (yet): FrameResult::outcome says why.
  virtual void frame_lost(const FrameResult& frame) { static_cast<void>(frame); }
  /// A frame became a keyframe of the map.
  virtual void keyframe_added(const KeyframeAdded& keyframe) { static_cast<void>(keyframe); }
  /// A loop candidate passed all tests; the map is optimized with it right after.
  virtual void loop_accepted(const LoopRecord& loop) { static_cast<void>(loop); }
  /// A loop candidate failed the test LoopRecord::stage.
  ///
  /// One that waits for the support of a second loop (LoopStage::kSupport) may still be accepted
  /// with a later keyframe.
  virtual void loop_refused(const LoopRecord& loop) { static_cast<void>(loop); }
  /// A keyframe founded a place, or a merger that odometry contradicts was undone.
  virtual void place_added(const PlaceAdded& place) { static_cast<void>(place); }
  /// Two places became one.
  virtual void places_merged(const PlacesMerged& places) { static_cast<void>(places); }
  /// Two sub-maps became one.
  virtual void component_joined(const ComponentJoined& component) { static_cast<void>(component); }
  /// Places were moved by an optimization, or lengths have got their unit.
  virtual void map_moved(const MapMoved& move) { static_cast<void>(move); }
};

}  // namespace placegraph
