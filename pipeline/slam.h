#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/slam_options.h>
#include <placegraph/pipeline/tracking/frame_result.h>

#include <functional>
#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class MeasuredMotion;
class PlaceRetrieval;
class SlamEvents;
struct DataNote;
struct EnvironmentObservation;
struct FrameView;
struct LensDistortion;
struct MapChanges;
struct OdometryError;
struct PlaceHistory;
struct SceneModel;
struct StageTime;

/// Optional inputs of Slam besides options and calibration.
struct SlamInputs {
  /// Motion of the (left) camera measured by other sensors (wheels, laser, inertial sensors), with
  /// time stamps on the clock of the frames [ns]. It makes the scale of a monocular camera
  /// observable, adds robust constraints to the place graph, and bridges stretches in which visual
  /// tracking fails.
  std::shared_ptr<const MeasuredMotion> motion = nullptr;
  /// Trained model that labels surfaces; required if `semantics` or `context` is enabled.
  std::shared_ptr<const SceneModel> surfaces = nullptr;
  /// Place recognizer of the caller's own (frontend/places/place_recognizer.h), which finds the
  /// candidates of loops and of relocalization instead of visual words. LoopRecord::similarity is
  /// then its score, and LoopOptions::min_similarity is not used.
  std::shared_ptr<PlaceRetrieval> recognizer = nullptr;
  /// Listener for events; not owned, must outlive the Slam object.
  SlamEvents* events = nullptr;
  LogSink log = {};  ///< receiver of log messages; may be empty
};

/// Complete SLAM system: takes frames, estimates the place graph and the trajectory.
///
///     Slam slam(options, calibration);
///     for (frame : frames) slam.add_frame(frame);
///     Map map = slam.finish();
///
/// The camera is treated as stereo if the calibration has a baseline, as RGB-D if it has a depth
/// camera, and as monocular otherwise. A monocular map is metric if the camera height is known or
/// if other sensors measure the motion. Objects share no state; any number may exist in one
/// process. Equal frames, options and libraries give bit-identical results. Poses are T_map_cam of
/// the (left) camera. A moved-from object may only be destroyed or assigned to.
class Slam {
 public:
  /// Prepares a run; processing begins with the first frame.
  ///
  /// Throws ArgumentError for options or a calibration that their check() rejects, or if
  /// `semantics` or `context` is enabled without a model of surfaces.
  Slam(const SlamOptions& options, const Calibration& calibration, const SlamInputs& inputs = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// Returns the frame of a number.
  using FrameOf = std::function<Frame(FrameId)>;
  /// Resumes an interrupted run; must be called before the first frame.
  ///
  /// `map` and `history` are those of the saved run. `last` is the frame of its last keyframe; it
  /// is processed again, and tracking restarts there as after a loss. Records of later frames are
  /// dropped; add_frame continues with the frame after `last`. Throws ArgumentError if map and
  /// history are inconsistent, if `last` is another frame, or if frames have already been added;
  /// the object must then not be used any more. A SlamInputs::recognizer needs the images of the
  /// map's keyframes: `frame_of` returns their frames, as they were processed (ArgumentError
  /// without it).
  void resume(const Map& map, const PlaceHistory& history, const Frame& last,
              const FrameOf& frame_of = {});
  /// Processes one frame; returns its current pose estimate, or the reason why it has none.
  ///
  /// The images are referenced, not copied, for as long as tracking needs them: pass a clone() of a
  /// buffer that will be overwritten or freed.
  /// Throws ArgumentError if the size or type of an image differs from the calibration, if id or
  /// stamp does not increase, or after finish(); the frame is then ignored. After any other
  /// exception, as one of a callback, the object is of no use: the next call throws ArgumentError.
  FrameResult add_frame(const Frame& frame);
  /// Returns the changes of the map since the last call, for MapDatabase::commit.
  ///
  /// Frames, features and landmarks are included if they are new or have changed; the places, their
  /// history and the loops are included each time. The appearance of keyframes is moved into the
  /// result: later calls and snapshots do not contain it.
  MapChanges take_changes();
  /// Returns a copy of the current map and trajectories; may be called between frames.
  Map snapshot() const;
  /// Optimizes the place graph to convergence and returns the map.
  ///
  /// Later calls of finish() and add_frame() throw ArgumentError, as does finish() after an
  /// exception of an earlier call.
  Map finish();
  /// Returns the radial distortion estimated so far; for a stereo pair it remains unknown.
  ///
  /// run_sequence restarts with undistorted images if the thresholds of LensOptions are exceeded
  /// within its first frames.
  LensDistortion lens() const;
  /// Returns a mask that is 0 in regions of the images that are fixed to the camera.
  ///
  /// It is CV_8UC1 and of the (left) images; it is empty as long as nothing is found. Later frames
  /// are masked by it; run_sequence restarts.
  Image overlay_mask() const;
  /// Returns doubts that the frames so far raise.
  ///
  /// They concern the images, the calibration and the motion; each has a cause.
  std::vector<DataNote> notes() const;
  /// Returns the errors of the motion from the first place to the last one of its component.
  ///
  /// Nothing if the run did not track all of the path between them.
  std::optional<OdometryError> odometry_error() const;
  /// Returns one entry per keyframe of this run, in order; empty unless `context` is enabled.
  const std::vector<EnvironmentObservation>& environments() const;
  /// Returns the tracked features of the last frame [px]; empty lists if that frame is lost.
  FrameView view() const;
  /// Returns the CPU time [s] used so far by each stage.
  const std::vector<StageTime>& stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
