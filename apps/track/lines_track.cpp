#include "apps/track/lines_track.h"

#include <fmt/format.h>
#include <placegraph/frontend/lines/track_consistency.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// The upper median; needs at least one value.
double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct TrackedLine {
  FrameId frame;
  FrameView::Line line;
};
using LineTracks = std::map<LineId, std::vector<TrackedLine>>;

RunOptions run_options(const LinesTrackArguments& arguments) {
  RunOptions options;
  for (const std::string& setting : arguments.settings)
    set_option(options, setting, option_notes());
  set_option(options, "sensor=" + arguments.sensor);
  options.slam.odometry.cues = arguments.cues;
  options.slam.loops.enabled = false;
  options.check();
  return options;
}

LineTracksJudgement judge(const LineTracks& tracks, const Camera& camera, const Trajectory& truth) {
  LineTracksJudgement all;
  for (const auto& [id, track] : tracks) {
    std::vector<SE3> T_world_cam;
    std::vector<ImageLine::Carriers> seen;
    for (const TrackedLine& s : track) {
      const auto index = static_cast<std::size_t>(s.frame.value());
      if (index >= truth.poses.size() || !truth.poses[index].T_world_body) continue;
      const Eigen::Isometry3d& T = *truth.poses[index].T_world_body;
      T_world_cam.emplace_back(SO3::from_matrix(T.linear()), Eigen::Vector3d(T.translation()));
      seen.push_back(s.line.seen);
    }
    const TrackConsistency judged = judge_line_track(camera, T_world_cam, seen);
    (judged.judged ? all.judged : all.undecided) += seen.size();
    all.wrong += static_cast<std::size_t>(judged.wrong());
  }
  return all;
}

std::string tracks_text(const LineTracks& tracks) {
  std::string text;
  for (const auto& [id, track] : tracks)
    for (const TrackedLine& s : track)
      text += fmt::format("{} {} {:.3f} {:.3f} {:.3f} {:.3f}\n", id.value(), s.frame.value(),
                          s.line.segment.start.x(), s.line.segment.start.y(),
                          s.line.segment.end.x(), s.line.segment.end.y());
  return text;
}

void count_lengths(const LineTracks& tracks, LinesTrackResult& result) {
  std::vector<double> lengths, of_use;
  for (const auto& [id, observations] : tracks)
    lengths.push_back(static_cast<double>(observations.size()));
  // A line with fewer than three views contributes nothing to motion or structure.
  std::copy_if(lengths.begin(), lengths.end(), std::back_inserter(of_use),
               [](double n) { return n >= 3; });
  result.tracks = tracks.size();
  result.median_length_frames = middle_of(lengths);
  result.tracks_of_use = of_use.size();
  result.median_length_of_use = of_use.empty() ? 0 : middle_of(of_use);
}

}  // namespace

double LineTracksJudgement::wrong_percent() const {
  return judged ? 100.0 * static_cast<double>(wrong) / static_cast<double>(judged) : 0;
}

LinesTrackResult lines_track(const LinesTrackArguments& arguments) {
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  const RunOptions options = run_options(arguments);
  const auto dataset = open_dataset(arguments.sequence);
  LineTracks tracks;
  RunInputs inputs;
  inputs.observer = [&](const Frame& frame, const FrameResult& frame_result,
                        const FrameView& view) {
    if (frame_result.state != TrackingState::kTracking) return;
    for (const FrameView::Line& line : view.lines) tracks[line.id].push_back({frame.id, line});
  };
  const RunResult run = run_sequence(*dataset, options, inputs);
  if (run.broken_off) throw NoResult(*run.broken_off);
  if (tracks.empty()) throw NoResult(arguments.sequence + ": no line was followed");
  if (!arguments.out.empty()) write_file(arguments.out, tracks_text(tracks));
  LinesTrackResult result;
  result.sequence = dataset->name();
  count_lengths(tracks, result);
  if (const auto& truth = dataset->ground_truth())
    result.judgement = judge(tracks, run.calibration.camera, *truth);
  return result;
}

std::string to_text(const LinesTrackResult& result) {
  std::string line = fmt::format("{}: {} lines followed, median over {:g} frames", result.sequence,
                                 result.tracks, result.median_length_frames);
  if (const auto& judged = result.judgement)
    line += fmt::format("; by the true poses {} of {} observations wrong ({:.2f} %), {} undecided",
                        judged->wrong, judged->judged, judged->wrong_percent(), judged->undecided);
  return line + "\n";
}

std::string to_json(const LinesTrackResult& result) {
  nlohmann::json json{{"tracks", result.tracks},
                      {"median_length_frames", result.median_length_frames},
                      {"tracks_of_use", result.tracks_of_use},
                      {"median_length_of_use_frames", result.median_length_of_use}};
  if (const auto& judged = result.judgement) {
    json["sightings"] = judged->judged;
    json["wrong"] = judged->wrong;
    json["wrong_percent"] = judged->wrong_percent();
    json["undecided"] = judged->undecided;
  }
  return json_text(json, 2);
}

}  // namespace placegraph::apps
