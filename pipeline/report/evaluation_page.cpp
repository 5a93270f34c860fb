#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/report/evaluation_page.h>

#include <fmt/format.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/eval/trajectory/rpe.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/page.h>
#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/report/tables/page_thinning.h>

namespace placegraph {
namespace {

using namespace report;
using nlohmann::json;
using Poses = std::vector<std::optional<Eigen::Isometry3d>>;

/// Errors of the frames that have an estimate; those of rotation only if there are orientations.
void put_errors(const std::vector<FramePair>& pairs, bool oriented, json& frames) {
  std::vector<float> error_m, error_deg;
  for (const FramePair& pair : pairs) {
    error_m.push_back(kUnknown);
    error_deg.push_back(kUnknown);
    if (!pair.T_world_estimate) continue;
    const Eigen::Isometry3d& T = *pair.T_world_estimate;
    error_m.back() =
        static_cast<float>((T.translation() - pair.T_world_truth.translation()).norm());
    error_deg.back() = static_cast<float>(
        rad_to_deg(rotation_angle(pair.T_world_truth.rotation().transpose() * T.rotation())));
  }
  frames["error_m"] = column(error_m);
  if (oriented) frames["error_deg"] = column(error_deg);
}

/// Without times the stamps are numbers of frames, and speeds follow from the usual rate.
bool has_times(const EvaluationResult& result) {
  return std::ranges::any_of(result.aligned_pairs,
                             [](const FramePair& pair) { return pair.stamp_ns != pair.frame; });
}

json frames_of(const EvaluationResult& result) {
  std::vector<std::int32_t> id, component;
  std::vector<double> stamp_s;
  Poses estimate, truth;
  const bool timed = has_times(result);
  for (const FramePair& pair : result.aligned_pairs) {
    id.push_back(pair.frame);
    component.push_back(pair.T_world_estimate ? 0 : -1);
    const auto stamp = static_cast<double>(pair.stamp_ns);
    stamp_s.push_back(timed ? 1e-9 * stamp : stamp / SegmentOptions().frame_rate_hz);
    estimate.push_back(pair.T_world_estimate);
    truth.emplace_back(pair.T_world_truth);
  }
  json frames = bare_frames(id, stamp_s);
  frames["component"] = column(component);
  frames["pose"] = pose_column(estimate);
  frames["truth"] = pose_column(truth);
  put_errors(result.aligned_pairs, static_cast<bool>(result.rpe.outcome), frames);
  return frames;
}

json table_of(const std::string& title, const std::string& protocol, const char* unit,
              const std::vector<SegmentGroup>& groups) {
  std::vector<std::vector<std::string>> rows;
  for (const SegmentGroup& group : groups)
    rows.push_back({group.from == group.to
                        ? fmt::format("{:g} {}", group.from, unit)
                        : fmt::format("{:g} to {:g} {}", group.from, group.to, unit),
                    fmt::format("{}", group.segments), fmt::format("{:.4f}", group.t_percent),
                    fmt::format("{:.4f}", group.r_deg_per_100m)});
  return describe_table(title, protocol, {"Segments", "Number", "t_rel [%]", "r_rel [deg/100m]"},
                        rows);
}

json tables_of(const EvaluationResult& result) {
  json tables = json::array();
  if (!result.segments.outcome) return tables;
  const std::string protocol = fmt::format(
      "segments begin at every {}th frame; mean over those of a row", result.protocol.step);
  tables.push_back(table_of("Errors by length", protocol, "m", result.segments.by_length));
  if (!result.segments.by_speed.empty())
    tables.push_back(table_of("Errors by speed", protocol, "m/s", result.segments.by_speed));
  return tables;
}

json run_of(const EvaluationResult& result, const EvaluationPage& page) {
  json run = bare_run(result.name, frames_of(result));
  const int last = result.aligned_pairs.empty() ? 0 : result.aligned_pairs.back().frame;
  const int first = result.aligned_pairs.empty() ? 0 : result.aligned_pairs.front().frame;
  run["recording"] = page.sequences ? result.name : page.truth;
  run["aligned"] = to_string(result.protocol.alignment);
  std::vector<std::optional<Eigen::Vector3d>> positions_m;
  for (const FramePair& pair : result.aligned_pairs)
    positions_m.emplace_back(pair.T_world_truth.translation());
  run["up"] = up_axis(positions_m);
  run["summary"]["frames"] = result.aligned_pairs.size();
  run["summary"]["posed"] = result.posed;
  run["components"].push_back(
      {{"number", 0}, {"main", true}, {"first", first}, {"last", last}, {"posed", result.posed}});
  run["notes"] = result.warnings;
  if (!has_times(result))
    run["notes"].push_back(
        fmt::format("the ground truth has no times: {:g} frames a second are assumed",
                    SegmentOptions().frame_rate_hz));
  run["figures"] = describe_figures(metrics(result));
  run["tables"] = tables_of(result);
  return run;
}

json averages_of(const std::vector<EvaluationResult>& results) {
  const AverageResult means = average(results);
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const Metric& metric, const std::string& how) {
    if (metric.value)
      rows.push_back({metric.name + how, fmt::format("{:.6g} {}", *metric.value, metric.unit)});
  };
  for (const Metric& metric : means.means) add(metric, ", mean of the sequences");
  add(means.pooled_t_rel, ", mean of all segments");
  add(means.pooled_r_rel, ", mean of all segments");
  return describe_table("Averages",
                        fmt::format("{} sequences, {} segments", means.sequences, means.segments),
                        {"Figure", "Value"}, rows);
}

/// The figures of `eval --plot`; those that the results do not allow are left out.
/// `detail`: share of the bytes that a picture alone has.
json figures_of(const EvaluationPage& page, const std::string& aligned, double detail) {
  const EvaluatedTruth truth = page.sequences ? EvaluatedTruth::kOwn : EvaluatedTruth::kShared;
  constexpr std::pair<EvaluationPlot, const char*> kTitles[] = {
      {EvaluationPlot::kOverview, "Evaluation"},
      {EvaluationPlot::kXyz, "Coordinates"},
      {EvaluationPlot::kRpy, "Roll, pitch and yaw"},
      {EvaluationPlot::kRpe, "Relative errors of consecutive frames"},
      {EvaluationPlot::kLengths, "Errors over the lengths of segments"},
      {EvaluationPlot::kBox, "Quartiles of the errors"},
      {EvaluationPlot::kViolin, "Densities of the errors"}};
  json pictures = json::array();
  for (const auto& [kind, title] : kTitles) {
    try {
      pictures.push_back(describe_picture(title, "against " + page.truth + ", align " + aligned,
                                          to_svg(figure_of(page.results, truth, kind), detail)));
    } catch (const ArgumentError&) {
      continue;
    }
  }
  return pictures;
}

}  // namespace

std::string evaluation_page(const EvaluationPage& page, const std::string& program) {
  std::string names, aligned;
  json runs = json::array();
  for (const EvaluationResult& result : page.results) {
    if (!result.outcome) continue;
    runs.push_back(run_of(result, page));
    names += (names.empty() ? "" : ", ") + result.name;
    aligned = to_string(result.protocol.alignment);
  }
  json report = bare_report(program, names + " against " + page.truth);
  report["runs"] = std::move(runs);
  report["pictures"] = figures_of(page, aligned, 1);
  if (page.sequences) report["tables"].push_back(averages_of(page.results));
  if (page_bytes(report) > kMostPageBytes) {
    constexpr double kDetailOfMany = 0.1;  // a third of the page
    report["pictures"] = figures_of(page, aligned, kDetailOfMany);
    thin_report(report);
  }
  return page_with(report);
}

void write_evaluation_page(const std::string& file, const EvaluationPage& page,
                           const std::string& program) {
  write_file(file, evaluation_page(page, program));
}

}  // namespace placegraph
