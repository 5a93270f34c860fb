#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/slam/frame_result.h>
#include <placegraph/pipeline/slam_options.h>

#include <limits>
#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class MeasuredMotion;
class SlamEvents;
struct EnvironmentSight;
struct FrameView;
struct MapChanges;
struct PlaceHistory;
struct SceneModel;

/// Radial distortion that images still show, though rectified ones should have none.
struct LensDistortion {
  double k1 = 0;  ///< first radial coefficient of OpenCV's model
  /// Standard deviation of k1; infinite before four windows have been seen.
  double sigma_k1 = std::numeric_limits<double>::infinity();
  /// What of it no other motion or structure would explain: rms over the tracks, in their standard
  /// deviations.
  double effect = 0;
};

/// What a run may be given beside options and calibration.
struct SlamInputs {
  /// The camera's motion as other sensors measured it (wheels, a laser, inertial ones), stamps
  /// those of the frames [ns]. It gives a single eye its unit, bears on the place graph as robust
  /// constraints, and carries on where nothing is seen.
  std::shared_ptr<const MeasuredMotion> motion;
  /// A model of surfaces; needed if `semantics` or `context` are enabled.
  std::shared_ptr<const SceneModel> surfaces;
  /// Told what happens, as it happens; not owned, must outlive the Slam object.
  SlamEvents* events = nullptr;
  LogSink log;  ///< where messages go; empty: nowhere
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
  Slam(const SlamOptions& options, const Calibration& calibration, const SlamInputs& inputs = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// Takes up a run that was broken off, before the first frame: its map and history, and the
  /// frame of its last keyframe, which is seen again; tracking begins there as after a loss.
  /// Records of frames after that one are dropped: they come next. Throws ArgumentError if map and
  /// history contradict each other or the frame is another.
  void resume(const Map& map, const PlaceHistory& history, const Frame& last);
  FrameResult add_frame(const Frame& frame);
  /// What the map has gained since the last call, at the cost of what it is. The views of keyframes
  /// that it tells are kept no longer.
  MapChanges take_changes();
  /// Map and trajectories as they stand; may be called between frames.
  Map snapshot() const;
  /// Optimizes once more and returns the map; neither it nor add_frame may be called afterwards.
  Map finish();
  /// What the images of one eye (or of a depth camera's) have shown so far; of stereo nothing.
  /// run_sequence begins again without it.
  LensDistortion lens() const;
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
