#pragma once
#include <placegraph/frontend/places/place_view.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/pipeline/loops/loop_closer.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/slam/environment_monitor.h>

namespace placegraph {

/// How keyframes look in all cues: kept in the map, so that images can be placed in it later.
struct KeyframeViewOptions {
  bool enabled = true;
  PlaceCueOptions cues;
};
void visit(OptionVisitor& field, KeyframeViewOptions& options);

/// Labels of surfaces for motion and places; the model is given by Slam::set_scene.
struct SceneUseOptions {
  bool enabled = false;
  SceneMaskOptions masks;
};
void visit(OptionVisitor& field, SceneUseOptions& options);

/// The kind of environment the camera is in, and what is assumed there.
struct ContextOptions {
  bool enabled = false;
  bool assume = true;  ///< the odometry takes for granted what holds there, and nothing else
  EnvironmentFilterOptions filter;
};
void visit(OptionVisitor& field, ContextOptions& options);

struct SlamOptions {
  std::uint64_t seed = 0;  ///< of every random stream
  OdometryOptions odometry;
  LoopOptions loops;
  PlaceOptions places;
  IncrementalOptions pose_graph;
  KeyframeViewOptions views;
  SceneUseOptions semantics;
  ContextOptions context;
  int max_lost_frames = 10;  ///< then a new component of the map begins
  void check() const;
};
void visit(OptionVisitor& field, SlamOptions& options);

/// What became of one frame.
struct FrameResult {
  FrameId frame;
  TrackingState state =
      TrackingState::kWaiting;   ///< waiting for the second view, tracking, or lost
  std::optional<SE3> T_map_cam;  ///< in the frame of `component`; nothing while unknown
  bool keyframe = false;
  bool new_place = false;
  int inliers = 0;
  int component = 0;
  int loops_accepted = 0;  ///< with this frame
  /// Why it has no pose (yet), or one that stands only if a second view confirms it; else empty.
  std::string reason;
};

/// The whole system: frames in, place graph and trajectory out.
///
///     Slam slam(options, calibration);
///     for (frame : frames) slam.add_frame(frame);
///     Map map = slam.finish();
///
/// Stereo if the calibration has a baseline, RGB-D if it has a depth camera, mono otherwise; mono
/// is metric if it has a camera height. Objects share nothing: any number may live in one process.
/// Same frames, options and libraries: same bits. Throws ArgumentError for options, calibration or
/// frames that break their contract (image of another size or type, stamps that do not increase).
class Slam {
 public:
  Slam(const SlamOptions& options, const Calibration& calibration, LogSink log = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// The camera's motion as other sensors measured it (wheels, a laser, inertial ones), stamps
  /// those of the frames; to be given before the first frame. It gives a single eye its unit, bears
  /// on the place graph as robust constraints, and carries on where nothing is seen.
  void set_motion(const MeasuredMotion& motion_cam);
  /// Takes up a run that was broken off, before the first frame: its map and history, and the
  /// frame of its last keyframe, which is seen again; tracking begins there as after a loss.
  /// Records of frames after that one are dropped: they come next. Throws ArgumentError if map and
  /// history contradict each other or the frame is another.
  void go_on_from(const Map& map, const PlaceHistory& history, const Frame& last);
  /// A model of surfaces (ArgumentError otherwise), to be given before the first frame if
  /// `semantics` or `context` are enabled.
  void set_scene(std::shared_ptr<const SceneModel> surfaces);
  FrameResult add_frame(const Frame& frame);
  /// What the map has gained since the last call, at the cost of what it is. The views of keyframes
  /// that it tells are kept no longer.
  MapChanges take_changes();
  /// Map and trajectories as they stand; may be called between frames.
  Map snapshot() const;
  /// Optimizes once more and returns the map; neither it nor add_frame may be called afterwards.
  Map finish();
  /// The radial distortion that the images of one eye (or of a depth camera's) still show, though
  /// they should not; run_sequence begins again without it.
  const LensEstimator& lens() const;
  /// Of every keyframe of this run, in their order; nothing unless `context` is enabled.
  const std::vector<EnvironmentSight>& environments() const;
  /// What the frontend sees in the last frame.
  FrameView view() const;
  /// CPU time that each stage has taken so far.
  const std::vector<StageTimes::Stage>& stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
