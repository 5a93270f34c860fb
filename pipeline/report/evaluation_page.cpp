#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/report/evaluation_page.h>

#include <fmt/format.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/trajectory/evaluation_options.h>
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

/// A value of each frame of a result, unknown where nothing sets it.
class FrameValues {
 public:
  explicit FrameValues(std::size_t frames) : values_(frames, kUnknown) {}
  float& operator[](std::size_t frame) { return values_[frame]; }
  json column() const { return report::column(values_); }

 private:
  std::vector<float> values_;
};

/// Values of the posed frames, in their order, of those that a result has.
json of_posed(const EvaluationResult& result, const std::vector<double>& values) {
  FrameValues frames(result.aligned_pairs.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < result.aligned_pairs.size() && next < values.size(); ++i)
    if (result.aligned_pairs[i].T_world_estimate) frames[i] = static_cast<float>(values[next++]);
  return frames.column();
}

/// Adds the series to the columns of the frames, and names it.
void add_series(const std::string& title, const char* unit, json column, json& run) {
  const std::string name = fmt::format("series_{}", run["frame_series"].size());
  run["frames"][name] = std::move(column);
  run["frame_series"].push_back({{"column", name}, {"title", title}, {"unit", unit}});
}

/// Position errors by direction, and relative errors at the end of each step.
void add_error_series(const EvaluationResult& result, json& run) {
  const ErrorComponents& parts = result.components;
  const std::string up = "Error along the vertical " + parts.vertical;
  const char* const titles[] = {"Error along the path", "Error across the path", up.c_str()};
  for (int row = 0; row < 3 && parts.outcome; ++row) {
    std::vector<double> values;
    for (const Eigen::Vector3d& error : parts.errors_m) values.push_back(error[row]);
    add_series(titles[row], "m", of_posed(result, values), run);
  }
  const auto add_steps = [&](const RelativeErrors& steps) {
    FrameValues translation(result.aligned_pairs.size()), rotation(result.aligned_pairs.size());
    for (const RelativeError& step : steps.errors) {
      translation[static_cast<std::size_t>(step.last)] = static_cast<float>(step.translation_m);
      rotation[static_cast<std::size_t>(step.last)] = static_cast<float>(step.rotation_deg);
    }
    const std::string over = "RPE over " + text_of(steps.delta);
    add_series(over + ", translation", "m", translation.column(), run);
    add_series(over + ", rotation", "deg", rotation.column(), run);
  };
  if (result.rpe.outcome) add_steps(result.rpe);
  for (const RelativeErrors& steps : result.relative)
    if (steps.outcome) add_steps(steps);
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
  frames["error_m"] = of_posed(result, result.ape.frame_errors_m);
  if (result.ape.rotation_outcome)
    frames["error_deg"] = of_posed(result, result.ape.frame_errors_deg);
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

/// Statistics of every kind of error.
json errors_table(const EvaluationResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const ErrorRow& row : error_rows(result)) {
    const Statistics& s = row.statistics;
    std::vector<std::string> cells = {row.unit.empty() ? row.name
                                                       : fmt::format("{} [{}]", row.name, row.unit)};
    for (const double value : {s.rmse, s.mean, s.median, s.std_dev, s.p95, s.max})
      cells.push_back(fmt::format("{:.4f}", value));
    cells.push_back(fmt::format("{}", s.count));
    rows.push_back(std::move(cells));
  }
  return describe_table("Errors", "errors along directions have signs, their mean is a bias",
                        {"Error", "RMSE", "Mean", "Median", "Std", "95 %", "Max", "Count"}, rows);
}

json profile_table(const std::string& title, const char* unit,
                   const std::vector<ErrorGroup>& groups) {
  std::vector<std::vector<std::string>> rows;
  for (const ErrorGroup& group : groups)
    rows.push_back({fmt::format("{:g} to {:g} {}", group.from, group.to, unit),
                    fmt::format("{}", group.frames), fmt::format("{:.4f}", group.ate_rmse_m),
                    fmt::format("{:.4f}", group.rpe_trans_m),
                    fmt::format("{:.4f}", group.rpe_rot_deg)});
  return describe_table(title, "frames of each interval; relative errors of consecutive frames",
                        {"Interval", "Frames", "ATE [m]", "RPE [m]", "RPE [deg]"}, rows);
}

json worst_table(const std::vector<WorstStretch>& stretches) {
  constexpr std::size_t kRows = 10;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(kRows, stretches.size()); ++i)
    rows.push_back({fmt::format("{} to {}", stretches[i].first_frame, stretches[i].last_frame),
                    fmt::format("{:.1f} to {:.1f} m", stretches[i].first_m, stretches[i].last_m),
                    fmt::format("{:.4f}", stretches[i].largest)});
  return describe_table("Largest position errors",
                        "stretches of the hundredth of frames with the largest errors",
                        {"Frames", "Path", "Largest [m]"}, rows);
}

json tables_of(const EvaluationResult& result) {
  json tables = json::array();
  tables.push_back(errors_table(result));
  tables.push_back(worst_table(result.profile.worst));
  tables.push_back(profile_table("Errors by distance", "m", result.profile.by_distance));
  if (!result.profile.by_speed.empty()) {
    tables.push_back(profile_table("Errors by speed of the frame", "m/s", result.profile.by_speed));
    tables.push_back(
        profile_table("Errors by turning rate", "deg/s", result.profile.by_turning));
  }
  if (!result.segments.outcome) return tables;
  const std::string protocol = fmt::format(
      "segments begin at every {}th frame; mean over those of a row", result.protocol.step);
  tables.push_back(table_of("Errors of segments by length", protocol, "m", result.segments.by_length));
  if (!result.segments.by_speed.empty())
    tables.push_back(table_of("Errors of segments by speed", protocol, "m/s", result.segments.by_speed));
  return tables;
}

json run_of(const EvaluationResult& result, const EvaluationPage& page) {
  json run = bare_run(result.name, frames_of(result));
  add_error_series(result, run);
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
