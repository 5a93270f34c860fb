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
struct EnvironmentObservation;
struct FrameView;
struct MapChanges;
struct PlaceHistory;
struct SceneModel;

/// Radial distortion that images still show, though undistorted ones should have none.
struct LensDistortion {
  double k1 = 0;  ///< first radial coefficient of OpenCV's model; 0 before anything was estimated
  /// Standard deviation of k1; infinite before the evidence of about four windows.
  double sigma_k1 = std::numeric_limits<double>::infinity();
  /// Displacement of the tracks by k1 that no other motion or structure explains: root mean square
  /// in standard deviations of the tracks.
  double effect = 0;
};

/// What Slam may be given beside options and calibration.
struct SlamInputs {
  /// Motion of the (left) camera that other sensors measured (wheels, laser, inertial sensors), on
  /// the clock of the frames [ns]. It gives a monocular camera its scale, adds robust constraints
  /// to the place graph, and carries on where nothing is seen.
  std::shared_ptr<const MeasuredMotion> motion = nullptr;
  /// A trained model that labels surfaces; needed if `semantics` or `context` are enabled.
  std::shared_ptr<const SceneModel> surfaces = nullptr;
  /// Receives events as they happen; not owned, must outlive the Slam object.
  SlamEvents* events = nullptr;
  LogSink log = {};  ///< where messages go; empty: nowhere
};

/// The whole system: frames in, place graph and trajectory out.
///
///     Slam slam(options, calibration);
///     for (frame : frames) slam.add_frame(frame);
///     Map map = slam.finish();
///
/// Stereo if the calibration has a baseline, RGB-D if it has a depth camera, monocular otherwise; a
/// monocular map is metric if the camera height is known or other sensors measure the motion.
/// Objects share nothing: any number may live in one process. Same frames, options and libraries:
/// same bits. Poses are T_map_cam of the (left) camera. An object that was moved from may only be
/// destroyed or assigned to.
class Slam {
 public:
  /// Prepares a run. Nothing is processed before the first frame.
  ///
  /// Throws ArgumentError for options or a calibration that their check() refuses, or if
  /// `semantics` or `context` are enabled without a model of surfaces.
  Slam(const SlamOptions& options, const Calibration& calibration, const SlamInputs& inputs = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// Resumes a run that was broken off; call it before the first frame.
  ///
  /// `map` and `history` are those of the saved run, `last` is the frame of its last keyframe,
  /// which is processed again: tracking begins there as after a loss. Records of later frames are
  /// dropped; add_frame goes on with the frame after `last`. Throws ArgumentError if map and
  /// history contradict each other, the frame is another, or frames have been added already; the
  /// object must then not be used any more.
  void resume(const Map& map, const PlaceHistory& history, const Frame& last);
  /// Processes one frame; returns its pose as it is known now, or why it has none.
  ///
  /// The images are kept, not copied, for as long as tracking needs them: hand over a clone() of a
  /// buffer that is written again or freed.
  /// Throws ArgumentError if an image has another size or type than the calibration says, if id or
  /// stamp do not increase, or after finish().
  FrameResult add_frame(const Frame& frame);
  /// Returns what the map has gained since the last call, for MapDatabase::commit.
  ///
  /// Frames, features and landmarks are told where they are new or have changed; the places, their
  /// history and the loops each time. The appearance of keyframes is handed over: later calls and
  /// snapshots do not hold it.
  MapChanges take_changes();
  /// A copy of map and trajectories as they stand; may be called between frames.
  Map snapshot() const;
  /// Optimizes the place graph to convergence and returns the map.
  ///
  /// Afterwards, finish() and add_frame() throw ArgumentError.
  Map finish();
  /// Radial distortion that the images have shown so far; for a stereo pair it stays unknown.
  ///
  /// run_sequence begins again with undistorted images where LensOptions call it proven.
  LensDistortion lens() const;
  /// One entry per keyframe of this run, in their order; empty unless `context` is enabled.
  const std::vector<EnvironmentObservation>& environments() const;
  /// What the frontend sees in the last frame, in pixels; empty lists if that frame is lost.
  FrameView view() const;
  /// CPU time [s] that each stage has taken so far.
  const std::vector<StageTimes::Stage>& stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
