#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/pipeline/run_options.h>
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/environment_sight.h>

#include <functional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct FrameView;

/// The SLAM options stand beside the others, not in a group of their own.
void visit(OptionVisitor& field, RunOptions& options);

/// Frames of a run that have no pose in the end, by the reason that was given when they were done.
struct UnposedFrames {
  std::string reason;  ///< of the first of them
  int count = 0;
};

struct RunResult {
  Sensor sensor = Sensor::kMono;
  Calibration calibration;
  /// Radial distortion (k1) that was taken out of the images, which should have had none.
  double lens_k1 = 0;
  Map map;
  /// A frame could not be read: the map holds the frames before it. The message of its FileError.
  std::optional<std::string> broken_off;
  /// The first frame that was worked on, where the run went on with one that had been broken off.
  std::optional<FrameId> resumed_at;
  /// Reading and the stages of Slam. With more than one thread the next frame is read while the
  /// last is worked on, and counts for the stage that is open then.
  std::vector<StageTimes::Stage> stages;
  /// Why frames have no pose, the most frequent reason first; reasons that differ in numbers alone
  /// are one. Frames before a resumed run are not told.
  std::vector<UnposedFrames> unposed;
  /// What keyframes say of their surroundings, where `context` is enabled.
  std::vector<EnvironmentSight> environments;
};

/// Where a run saves its map as it goes (io/map/map_database.h): after every new place and at the
/// end.
struct MapFile {
  std::string path;
  std::string sequence;  ///< as it can be opened again
  bool resume = false;   ///< go on with the run that was broken off there
};

/// The sensor that a sequence is run as. Throws ArgumentError if it lacks what that needs.
Sensor choose_sensor(const Dataset& dataset, SensorChoice choice);

/// Called after each frame with the number done and of all, and what became of it.
using RunProgress = std::function<void(std::size_t done, std::size_t total, const FrameResult&)>;

/// Called after each frame with its images, what became of it, and what the frontend sees in it.
using FrameObserver =
    std::function<void(const Frame& frame, const FrameResult& result, const FrameView& view)>;

/// What a run may be given beside the sequence and its options.
struct RunInputs {
  /// A model of surfaces; needed if `semantics` or `context` are enabled.
  std::shared_ptr<const SceneModel> surfaces;
  /// To save the map in, or to resume: then the frames up to the last committed place are as they
  /// were.
  std::optional<MapFile> map_file;
  RunProgress progress;
  FrameObserver observer;
  SlamEvents* events = nullptr;  ///< not owned; those of a run that begins anew are told anew
  LogSink log;
};

/// Runs the system over a sequence, every frame, never sleeping; once or twice from the beginning
/// where the images of one eye prove to be distorted. Same result for any number of threads. Throws
/// as Slam and the data set do; an unreadable frame that is not the first ends the run.
RunResult run_sequence(const Dataset& dataset, const RunOptions& options,
                       const RunInputs& inputs = {});

/// "mono", "stereo", "rgbd".
const char* to_string(Sensor sensor);

}  // namespace placegraph
