#include "apps/views/cmd_lines_track.h"

#include <fmt/format.h>
#include <placegraph/frontend/lines/track_consistency.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/run.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct Sighting {
  std::int64_t frame = 0;
  FrameView::Line line;
};
using Tracks = std::map<std::int64_t, std::vector<Sighting>>;

struct LinesTrackArguments {
  std::string sequence, out, sensor = "auto", cues = "lines";
  std::vector<std::string> settings;
  bool as_json = false, force = false;
};

/// What the truth says of the associations.
struct Judgement {
  std::size_t judged = 0, wrong = 0, undecided = 0;  ///< sightings
};

Judgement judge(const Tracks& tracks, const Camera& camera, const Trajectory& truth) {
  Judgement all;
  for (const auto& [id, track] : tracks) {
    std::vector<LineSighting> sightings;
    for (const Sighting& s : track) {
      const auto index = static_cast<std::size_t>(s.frame);
      if (index >= truth.poses.size() || !truth.poses[index].T_world_body) continue;
      const Eigen::Isometry3d& T = *truth.poses[index].T_world_body;
      sightings.push_back(
          {SE3(SO3::from_matrix(T.linear()), Eigen::Vector3d(T.translation())), s.line.seen});
    }
    const TrackConsistency judged = judge_line_track(camera, sightings);
    (judged.judged ? all.judged : all.undecided) += sightings.size();
    all.wrong += static_cast<std::size_t>(judged.wrong());
  }
  return all;
}

std::string text_of(const Tracks& tracks) {
  std::string text;
  for (const auto& [id, track] : tracks)
    for (const Sighting& s : track)
      text +=
          fmt::format("{} {} {:.3f} {:.3f} {:.3f} {:.3f}\n", id, s.frame, s.line.segment.start.x(),
                      s.line.segment.start.y(), s.line.segment.end.x(), s.line.segment.end.y());
  return text;
}

void track(const LinesTrackArguments& arguments) {
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  RunOptions options;
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  set_option(options, "sensor=" + arguments.sensor);
  options.slam.odometry.cues = arguments.cues;
  options.slam.loops.enabled = false;
  options.check();
  const auto dataset = open_dataset(arguments.sequence);
  Tracks tracks;
  const RunResult result =
      run_sequence(*dataset, options, {}, {},
                   [&](const Frame& frame, const FrameResult& frame_result, const FrameView& view) {
                     if (frame_result.state != TrackingState::kTracking) return;
                     for (const FrameView::Line& line : view.lines)
                       tracks[line.id].push_back({frame.id, line});
                   });
  if (result.broken_off) throw NoAnswer(*result.broken_off);
  if (tracks.empty()) throw NoAnswer(arguments.sequence + ": no line was followed");
  if (!arguments.out.empty()) write_file(arguments.out, text_of(tracks));
  std::vector<double> lengths;
  for (const auto& [id, sightings] : tracks)
    lengths.push_back(static_cast<double>(sightings.size()));
  const double median = median_of(lengths);
  nlohmann::json figures{{"tracks", tracks.size()}, {"median_length_frames", median}};
  // Fewer than three views of a line say nothing of motion or place.
  std::vector<double> of_use;
  std::copy_if(lengths.begin(), lengths.end(), std::back_inserter(of_use),
               [](double n) { return n >= 3; });
  figures["tracks_of_use"] = of_use.size();
  figures["median_length_of_use_frames"] = of_use.empty() ? 0 : median_of(of_use);
  std::string line = fmt::format("{}: {} lines followed, median over {:g} frames", dataset->name(),
                                 tracks.size(), median);
  if (const auto& truth = dataset->ground_truth()) {
    const Judgement judged = judge(tracks, result.calibration.camera, *truth);
    const double percent = judged.judged ? 100.0 * static_cast<double>(judged.wrong) /
                                               static_cast<double>(judged.judged)
                                         : 0;
    figures["sightings"] = judged.judged;
    figures["wrong"] = judged.wrong;
    figures["wrong_percent"] = percent;
    figures["undecided"] = judged.undecided;
    line += fmt::format("; by the true poses {} of {} sightings wrong ({:.2f} %), {} undecided",
                        judged.wrong, judged.judged, percent, judged.undecided);
  }
  fmt::print("{}\n", arguments.as_json ? figures.dump(2) : line);
}

}  // namespace

void add_lines_track_command(CLI::App& lines) {
  auto arguments = std::make_shared<LinesTrackArguments>();
  LinesTrackArguments& a = *arguments;
  CLI::App* command = lines.add_subcommand(
      "track", "Follow straight edges through a sequence; with true poses, count wrong ones");
  command->footer("placegraph lines track SEQUENCE -o tracks.txt");
  command->add_option("SEQUENCE", a.sequence, "data set")->required();
  command->add_option("-o,--out", a.out, "file to write, `id frame u1 v1 u2 v2` a line");
  command->add_option("--sensor", a.sensor, "what to run it as")
      ->check(CLI::IsMember({"auto", "mono", "stereo", "rgbd"}))
      ->capture_default_str();
  command->add_option("--cues", a.cues, "what the motion is seen by, lines among them")
      ->capture_default_str();
  command->add_option("--set", a.settings, "an option of the run, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT");
  command->callback([arguments] { track(*arguments); });
}

}  // namespace placegraph::apps
