#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/pipeline/run_options.h>
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/environment_observation.h>

#include <functional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct FrameView;

/// Lists the SLAM options at the top level, not in a group of their own.
void visit(OptionVisitor& field, RunOptions& options);

/// Number of frames without a final pose that share one reason.
struct UnposedFrames {
  /// Reason of the first of these frames: its FrameResult::outcome, or the statement that its
  /// component was never joined to the map.
  std::string reason;
  int count = 0;  ///< number of frames, at least 1
};

/// Result of run_sequence.
struct RunResult {
  Sensor sensor = Sensor::kMono;  ///< sensor configuration of the run
  Calibration calibration;        ///< calibration of the images as used, without distortion
  /// Radial distortion coefficient (k1 of OpenCV's model) that was removed from the images, which
  /// were expected to be undistorted; 0: nothing was removed.
  double lens_k1 = 0;
  Map map;  ///< final map, optimized to convergence
  /// Message of the FileError if a frame could not be read; the map then contains the frames before
  /// it.
  std::optional<std::string> broken_off;
  /// Whether RunInputs::stop ended the run: the map holds the frames before.
  bool stopped = false;
  /// First frame that was processed, if the map goes on from that of an interrupted run; nothing if
  /// the run has begun again.
  std::optional<FrameId> resumed_at;
  /// CPU time of reading images and of the stages of Slam, in all passes of the run, also before it
  /// was interrupted. With more than one thread, the next frame is read while the current one is
  /// processed, and the reading time is added to the stage that is active then.
  std::vector<StageTime> stages;
  /// Reasons why frames have no pose, the most frequent first. Reasons that differ only in numbers
  /// are merged.
  std::vector<UnposedFrames> unposed;
  /// Doubts about the images, the calibration and the motion that the frames show (Slam::notes).
  std::vector<DataNote> notes;
  /// Errors of the motion from the first place to the last one (Slam::odometry_error).
  std::optional<OdometryError> odometry_error;
  /// Environment of each keyframe; empty unless `context` is enabled.
  std::vector<EnvironmentObservation> environments;
};

/// Judges a run by its map, by RunResult::notes and by `notes` on its data and options.
///
/// Decides whether lengths are metres: its scale was measured and no finding doubts it. Map::metric
/// of the run's map then says the same as the judgement. `min_posed` is the share of frames in
/// [0, 1] that must have a pose.
Judgement judge(RunResult& run, const std::vector<DataNote>& notes, double min_posed);

/// File in which a run saves its map, after every new place and at the end.
///
/// The format is that of io/map/map_database.h.
struct MapFile {
  std::string path;      ///< path of the database, which is created with the first place
  std::string sequence;  ///< path of the sequence with which open_dataset can open it again
  bool resume = false;   ///< whether to resume the run that was interrupted there
};

/// Selects the sensor configuration: the requested one, or the best available for kAuto.
///
/// Throws ArgumentError if the sequence lacks the images that the sensor needs.
Sensor choose_sensor(const Dataset& dataset, SensorChoice choice);

/// Callback after each frame, with the number of processed frames, their total and the result.
using RunProgress = std::function<void(std::size_t done, std::size_t total, const FrameResult&)>;

/// Callback after each frame, with its images, its result and the frontend's view of it.
using FrameObserver =
    std::function<void(const Frame& frame, const FrameResult& result, const FrameView& view)>;

/// Callback after each frame, with the CPU time that reading and the stages of Slam took so far.
using StagesObserver = std::function<void(const std::vector<StageTime>& stages)>;

/// Optional inputs of a run besides the sequence and its options.
struct RunInputs {
  /// Trained model that labels surfaces; required if `semantics` or `context` is enabled.
  std::shared_ptr<const SceneModel> surfaces = nullptr;
  /// Place recognizer of the caller's own, see SlamInputs::recognizer. It is cleared at each start
  /// of the run, and gets the images of the keyframes again if a run is resumed. The map records
  /// DescriberOptions::recognizer as its name; a run that began with one is resumed with one.
  std::shared_ptr<PlaceRetrieval> recognizer = nullptr;
  /// File in which the map is saved, or from which the run resumes: the frames up to the last
  /// committed place are then read from the file.
  std::optional<MapFile> map_file = std::nullopt;
  RunProgress progress = {};    ///< progress callback; may be empty
  FrameObserver observer = {};  ///< callback with the images and tracks; may be empty
  StagesObserver stages = {};   ///< callback with the times so far; may be empty
  /// Event listener; not owned. run_began is called at each start of the run, including a restart
  /// with undistorted images.
  SlamEvents* events = nullptr;
  /// Called before each frame; `true` ends the run, which can be resumed later. May be empty.
  std::function<bool()> stop = {};
  LogSink log = {};  ///< receiver of log messages; may be empty
};

/// Runs SLAM on every frame of a sequence, as fast as possible.
///
/// Restarts if the first images of a monocular or RGB-D camera are found to be distorted
/// (LensOptions), and once more to refine or to undo the correction; distortion found later is one
/// of RunResult::notes. Restarts at most twice if something in the images is found to move with the
/// camera (StaticOverlayOptions): it is masked then. The result does not depend on the number of
/// threads. An unreadable frame other than the first ends the run (RunResult::broken_off). Throws
/// ArgumentError for options that their check() rejects or for a sequence that lacks the required
/// data, FileError for files that cannot be read or written.
RunResult run_sequence(const Dataset& dataset, const RunOptions& options,
                       const RunInputs& inputs = {});

/// Name of a sensor: "mono", "stereo" or "rgbd".
const char* to_string(Sensor sensor);

}  // namespace placegraph
