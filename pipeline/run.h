#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/pipeline/run_options.h>
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/environment_observation.h>

#include <functional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct FrameView;

/// Lists the SLAM options beside the others, not in a group of their own.
void visit(OptionVisitor& field, RunOptions& options);

/// Frames of a run that have no pose in the end, for one reason.
struct UnposedFrames {
  /// Of the first of them: that of FrameResult::outcome, or that its component was never joined.
  std::string reason;
  int count = 0;  ///< how many frames there are, at least 1
};

/// What run_sequence returns.
struct RunResult {
  Sensor sensor = Sensor::kMono;  ///< what the sequence was run as
  Calibration calibration;        ///< of the images as they were used, without their distortion
  /// Radial distortion (k1 of OpenCV's model) that was removed from the images, which should have
  /// had none; 0: nothing was removed.
  double lens_k1 = 0;
  Map map;  ///< optimized to convergence
  /// The message of the FileError if a frame could not be read: the map holds the frames before it.
  std::optional<std::string> broken_off;
  /// The first frame that was processed, if the run resumed one that had been broken off.
  std::optional<FrameId> resumed_at;
  /// CPU time of reading and of the stages of Slam. With more than one thread the next frame is
  /// read while the last is processed, and its time counts for the stage that is open then.
  std::vector<StageTimes::Stage> stages;
  /// Why frames have no pose, the most frequent reason first; reasons that differ in numbers alone
  /// are one. Frames before a resumed run are not counted.
  std::vector<UnposedFrames> unposed;
  /// What each keyframe shows of its environment; empty unless `context` is enabled.
  std::vector<EnvironmentObservation> environments;
};

/// Where a run saves its map (io/map/map_database.h), after every new place and at the end.
struct MapFile {
  std::string path;      ///< of the database; created with the first place
  std::string sequence;  ///< path of the sequence by which open_dataset finds it again
  bool resume = false;   ///< go on with the run that was broken off there
};

/// The sensor that a sequence is run as: the one asked for, or the best offered for kAuto.
///
/// Throws ArgumentError if the sequence lacks the images that the sensor needs.
Sensor choose_sensor(const Dataset& dataset, SensorChoice choice);

/// Called after each frame with the number of frames done, of all frames, and its result.
using RunProgress = std::function<void(std::size_t done, std::size_t total, const FrameResult&)>;

/// Called after each frame with its images, its result, and what the frontend sees in it.
using FrameObserver =
    std::function<void(const Frame& frame, const FrameResult& result, const FrameView& view)>;

/// What a run may be given beside the sequence and its options.
struct RunInputs {
  /// A trained model that labels surfaces; needed if `semantics` or `context` are enabled.
  std::shared_ptr<const SceneModel> surfaces = nullptr;
  /// Where the map is saved, or resumed from: the frames up to the last committed place are then
  /// taken from the file.
  std::optional<MapFile> map_file = std::nullopt;
  RunProgress progress = {};    ///< empty: nobody is told
  FrameObserver observer = {};  ///< empty: nobody is told
  /// Receives events; not owned. Each time the run begins (once more without distortion), run_began
  /// is called.
  SlamEvents* events = nullptr;
  LogSink log = {};  ///< where messages go; empty: nowhere
};

/// Runs the system over every frame of a sequence, as fast as it can.
///
/// Begins again, at most twice, where the images of a monocular or RGB-D camera prove to be
/// distorted (LensOptions). The result is the same for any number of threads. An unreadable frame
/// that is not the first ends the run (RunResult::broken_off). Throws ArgumentError for options
/// that their check() refuses or a sequence that does not offer what they ask for, FileError for
/// files that cannot be read or written.
RunResult run_sequence(const Dataset& dataset, const RunOptions& options,
                       const RunInputs& inputs = {});

/// Name of a sensor: "mono", "stereo" or "rgbd".
const char* to_string(Sensor sensor);

}  // namespace placegraph
