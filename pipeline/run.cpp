#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>
#include <placegraph/graph/scene/scene_model.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/io/sensors/odometry_file.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/frame_reader.h>
#include <placegraph/pipeline/learned_images.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/save_schedule.h>
#include <placegraph/pipeline/slam/run_evidence.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>

namespace placegraph {
namespace {

/// Throws FileError if a motion and the images do not overlap in time, or if the images cover only
/// a step or two of a long motion; logs a warning if the motion covers few pairs of frames.
void check_common_time(const std::string& path, const MeasuredMotion& motion,
                       const std::vector<std::int64_t>& stamps_ns, const LogSink& log) {
  if (stamps_ns.size() < 2) return;
  std::size_t covered = 0, steps_in_common = 0;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i)
    covered += motion.between(stamps_ns[i - 1], stamps_ns[i]).has_value();
  std::vector<std::int64_t> motion_ns = {motion.steps().front().from_ns};
  for (const MotionStep& step : motion.steps()) {
    motion_ns.push_back(step.to_ns);
    steps_in_common += step.to_ns > stamps_ns.front() && step.from_ns < stamps_ns.back();
  }
  const std::size_t pairs = stamps_ns.size() - 1;
  const bool within_few = steps_in_common <= 2 && motion.steps().size() > 2 && pairs > 2;
  if (2 * covered > pairs && !within_few) return;
  const std::string times =
      fmt::format("it is from {:.3f} to {:.3f} s, the images are from {:.3f} to {:.3f} s",
                  seconds(0, motion_ns.front()), seconds(0, motion_ns.back()),
                  seconds(0, stamps_ns.front()), seconds(0, stamps_ns.back()));
  if (covered > 0 && !within_few) {
    placegraph::log(log, LogLevel::kWarning,
                    "{}: covers the motion between {} of {} pairs of frames: {}", path, covered,
                    pairs, times);
    return;
  }
  const std::string clock = other_clock(stamps_ns, motion_ns, "the odometry");
  throw FileError(path, (covered > 0 ? "has almost no time in common with the images: "
                                     : "has no time in common with the images: ") +
                            times + (clock.empty() ? "" : "; " + clock));
}

/// Motion of the camera.
MeasuredMotion read_motion(const Dataset& dataset, const MotionOptions& options,
                           const LogSink& log) {
  std::vector<std::int64_t> stamps_ns;
  for (std::size_t i = 0; i < dataset.size(); ++i) stamps_ns.push_back(dataset.stamp_ns(i));
  const auto& v = options.T_cam_body;
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  const SE3 T_cam_body(q.normalized().toRotationMatrix(), Eigen::Vector3d(v[0], v[1], v[2]));
  const MeasuredMotion motion = read_odometry(options.file, options.noise, stamps_ns, log);
  check_common_time(options.file, motion, stamps_ns, log);
  return motion.seen_from(T_cam_body);
}

/// Number of frames after which a lens that is found no longer restarts a run: this bounds the work
/// that is repeated.
std::size_t frames_with_restart(std::size_t frames, const LensOptions& options) {
  constexpr std::size_t kShare = 5;  // a fifth of a long run
  return std::max(static_cast<std::size_t>(options.max_frames), frames / kShare);
}

/// Both tables; stages of one name are one.
std::vector<StageTime> sum_of(std::vector<StageTime> stages, const std::vector<StageTime>& more) {
  for (const StageTime& stage : more) {
    const auto same = std::ranges::find(stages, stage.name, &StageTime::name);
    if (same == stages.end()) {
      stages.push_back(stage);
    } else {
      same->cpu_s += stage.cpu_s;
      same->calls += stage.calls;
    }
  }
  return stages;
}

}  // namespace

const char* to_string(Sensor sensor) {
  switch (sensor) {
    case Sensor::kMono:
      return "mono";
    case Sensor::kStereo:
      return "stereo";
    case Sensor::kRgbd:
      return "rgbd";
  }
  return "";
}

Sensor choose_sensor(const Dataset& dataset, SensorChoice choice) {
  const auto offered = dataset.sensors();
  if (choice == SensorChoice::kAuto) return offered.front();
  const Sensor wanted = static_cast<Sensor>(static_cast<int>(choice) - 1);
  std::string all;
  for (const Sensor sensor : offered)
    all += (all.empty() ? "" : ", ") + std::string(to_string(sensor));
  require(std::find(offered.begin(), offered.end(), wanted) != offered.end(),
          dataset.name() + ": lacks the images that " + to_string(wanted) +
              " needs; it can be run as " + all);
  return wanted;
}

namespace {

std::string without_numbers(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; });
  return text;
}

std::vector<UnposedFrames> unposed_frames(const Trajectory& optimized, const Map& map) {
  std::map<std::string, UnposedFrames> kinds;
  for (std::size_t i = 0; i < map.frames.size() && i < optimized.size(); ++i) {
    const FrameRecord& frame = map.frames[i];
    const bool posed_apart = frame.T_keyframe_frame.has_value();
    if (optimized.poses[i].T_world_body || (frame.reason.empty() && !posed_apart)) continue;
    const std::string reason =
        posed_apart ? "not connected to the first component of the map" : frame.reason;
    UnposedFrames& kind = kinds[without_numbers(reason)];
    if (kind.count++ == 0) kind.reason = reason;
  }
  std::vector<UnposedFrames> result;
  for (auto& [text, kind] : kinds) result.push_back(std::move(kind));
  std::ranges::stable_sort(result, std::ranges::greater(), &UnposedFrames::count);
  return result;
}

SlamInputs slam_inputs(const Dataset& dataset, const RunOptions& options, const RunInputs& given) {
  SlamInputs inputs;
  inputs.surfaces = given.surfaces;
  inputs.recognizer = given.recognizer;
  inputs.events = given.events;
  inputs.log = given.log;
  if (!options.motion.file.empty())
    inputs.motion =
        std::make_shared<const MeasuredMotion>(read_motion(dataset, options.motion, given.log));
  return inputs;
}

/// Whether a saved map had metres before its judgement, which may have withdrawn them.
bool scale_measured(const StoredMap& stored) {
  const std::vector<bool>& measured = stored.history.scale_measured;  // of each track segment
  return stored.map.metric || (!measured.empty() && std::ranges::count(measured, false) == 0);
}

/// The map of a run that was already finished, and what it reported.
void take_saved(StoredMap stored, RunResult& result) {
  stored.map.metric = scale_measured(stored);  // it is judged again
  result.notes = std::move(stored.run.notes);
  result.odometry_error = stored.run.odometry_error;
  result.environments = environments_in(stored.history.evidence);
  result.stages = std::move(stored.run.stages);
  result.unposed = unposed_frames(stored.map.trajectory_optimized(), stored.map);
  result.map = std::move(stored.map);
}

/// A run that began with a recognizer goes on with one.
void check_recognizer(const StoredMap& stored, const RunInputs& inputs) {
  RunOptions begun;
  const std::string& path = inputs.map_file->path;
  if (stored.finished || stored.origin.options.empty()) return;
  read_options_text(path, stored.origin.options, begun);
  require_recognizer_again(begun.describer, path, inputs.recognizer != nullptr);
}

/// A run over a sequence, with the file in which it saves its map.
class SequenceRun {
 public:
  SequenceRun(const Dataset& dataset, const RunOptions& options, const RunInputs& inputs)
      : dataset_(dataset), options_(options), inputs_(inputs) {
    result_.sensor = choose_sensor(dataset, options.sensor);
    result_.calibration = dataset.calibration(result_.sensor);
    if (options.camera_height_m > 0) result_.calibration.camera_height_m = options.camera_height_m;
    images_ = {RunMask(options.mask, result_.calibration.camera), result_.calibration};
    begin_ = options.first_frame;
    require(begin_ < dataset.size(),
            "first_frame: the sequence has " + std::to_string(dataset.size()) + " frames");
    end_ = options.max_frames > 0 ? std::min(dataset.size(), begin_ + options.max_frames)
                                  : dataset.size();
  }

  RunResult run() {
    StoredMap stored;
    if (inputs_.map_file && inputs_.map_file->resume) {
      stored = read_map(interrupted_map_path(inputs_.map_file->path));
      check_recognizer(stored, inputs_);
      images_.take_up(stored.origin);
      earlier_stages_ = stored.run.stages;
      if (stored.finished) {
        result_.calibration = images_.calibration();
        result_.lens_k1 = images_.k1();
        result_.resumed_at = FrameId(begin_ + stored.map.frames.size());
        take_saved(std::move(stored), result_);
        return std::move(result_);
      }
      database_ = MapDatabase::open(inputs_.map_file->path);
    }
    while (!pass(stored)) {
      stored = StoredMap();
      result_.resumed_at.reset();
      if (!database_) continue;
      RunRecord until_now;
      until_now.stages = sum_of(times_.stages(), earlier_stages_);
      database_->restart(origin(), until_now);
    }
    return std::move(result_);
  }

 private:
  MapOrigin origin() const {
    MapOrigin origin;
    origin.sequence = inputs_.map_file->sequence;
    origin.sensor = result_.sensor;
    images_.describe(origin);
    RunOptions options = options_;
    options.threads = RunOptions().threads;  // the map does not depend on it
    origin.options = dump_options(options);
    if (options_.slam.views.enabled) origin.view_options = dump_options(options_.slam.views.cues);
    return origin;
  }

  /// Whether the run must restart with what frame `i` of the pass has shown of the images.
  bool restarts(const Slam& slam, std::size_t i) {
    if (images_.learn_overlay(slam, inputs_.log)) return true;
    if (i - begin_ >= frames_with_restart(end_ - begin_, options_.lens) ||
        dataset_.images_rectified() || !images_.learn_lens(slam.lens(), options_.lens, inputs_.log))
      return false;
    if (inputs_.events)
      inputs_.events->lens_found(
          {FrameId(i), images_.k1(), slam.lens().sigma_k1, images_.lens_pass() + 1});
    return true;
  }

  /// Processes the sequence; returns false if the images must be corrected and the run restarted.
  bool pass(const StoredMap& stored) {
    result_.calibration = images_.calibration();
    if (inputs_.events) inputs_.events->run_began();
    Slam slam(options_.slam, result_.calibration, slam_inputs(dataset_, options_, inputs_));
    FrameReader reader(dataset_, images_, result_.sensor, end_, options_.threads > 1);
    const std::size_t first = go_on(stored, reader, slam);
    SaveSchedule saves;
    saves.saved(first - begin_);
    for (std::size_t i = first; i < end_; ++i) {
      result_.stopped = inputs_.stop && inputs_.stop();
      if (result_.stopped) break;
      Frame frame;
      try {
        const auto span = times_.measure("reading");
        frame = reader.read(i);
      } catch (const FileError& error) {
        if (i == begin_) throw;
        result_.broken_off = error.what();
        break;
      }
      const FrameResult done = slam.add_frame(frame);
      if (inputs_.observer) inputs_.observer(frame, done, slam.view());
      if (inputs_.stages) inputs_.stages(stages(slam));
      if (inputs_.progress) inputs_.progress(i + 1 - begin_, end_ - begin_, done);
      if (restarts(slam, i)) {
        earlier_stages_ = sum_of(std::move(earlier_stages_), slam.stages());
        return false;
      }
      if (inputs_.map_file && done.new_place && saves.due(i + 1 - begin_)) {
        commit(slam, false);
        saves.saved(i + 1 - begin_);
      }
    }
    result_.lens_k1 = images_.k1();
    result_.map = slam.finish();
    result_.unposed = unposed_frames(result_.map.trajectory_optimized(), result_.map);
    if (inputs_.map_file) commit(slam, !result_.broken_off && !result_.stopped);
    result_.notes = images_.notes(slam, options_.lens);
    result_.odometry_error = slam.odometry_error();
    result_.environments = slam.environments();
    result_.stages = stages(slam);
    return true;
  }

  /// CPU time of all passes so far.
  std::vector<StageTime> stages(const Slam& slam) const {
    return sum_of(sum_of(times_.stages(), earlier_stages_), slam.stages());
  }

  /// Restores the saved state; returns the index of the next frame.
  std::size_t go_on(const StoredMap& stored, FrameReader& reader, Slam& slam) {
    if (stored.map.keyframes.empty()) return begin_;
    const auto last = static_cast<std::size_t>(stored.map.keyframes.back().frame.value());
    require(last >= begin_ && last < end_,
            inputs_.map_file->path + ": its last keyframe is frame " + std::to_string(last) +
                ", which is not in the sequence");
    const auto at = [&](FrameId id) { return reader.read(static_cast<std::size_t>(id.value())); };
    slam.resume(stored.map, stored.history, reader.read(last), at);
    result_.resumed_at = FrameId(last + 1);
    return last + 1;
  }

  /// The file is created with the first place: no file remains after an earlier failure.
  void commit(Slam& slam, bool last) {
    if (!database_) database_ = MapDatabase::create(inputs_.map_file->path, origin());
    const auto span = times_.measure("map database");
    MapChanges changes = slam.take_changes();
    changes.run.stages = stages(slam);
    if (last) changes.run.notes = images_.notes(slam, options_.lens);
    last ? database_->finish(changes) : database_->commit(changes);
  }

  const Dataset& dataset_;
  const RunOptions& options_;
  const RunInputs& inputs_;
  std::size_t begin_ = 0, end_ = 0;
  LearnedImages images_{RunMask(), Calibration()};
  std::optional<MapDatabase> database_;
  StageTimes times_;                       // of reading and saving
  std::vector<StageTime> earlier_stages_;  // of earlier passes
  RunResult result_;
};

}  // namespace

RunResult run_sequence(const Dataset& dataset, const RunOptions& options, const RunInputs& inputs) {
  options.check();
  RunOptions named = options;
  std::string& recognizer = named.describer.recognizer;
  if (!inputs.recognizer) require_no_recognizer(options.describer, "options");
  if (inputs.recognizer && recognizer.empty()) recognizer = "one of the calling program";
  return SequenceRun(dataset, named, inputs).run();
}

}  // namespace placegraph
