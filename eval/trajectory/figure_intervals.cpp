#include <fmt/format.h>
#include <placegraph/eval/trajectory/figure_intervals.h>
#include <placegraph/eval/uncertainty/drive_interval.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using Json = nlohmann::ordered_json;

/// The errors that a figure is the mean or the RMSE of.
struct FigureSeries {
  std::string key, name, unit;
  SeriesFigure figure = SeriesFigure::kRmse;
  std::vector<ErrorSeries> series;
};

ErrorSeries steps_of(const EvaluationResult& r, const RelativeErrors& steps,
                     double RelativeError::* error) {
  ErrorSeries series;
  series.stretch = text_of(steps.delta);
  for (const RelativeError& step : steps.errors)
    series.errors.push_back({r.aligned_pairs[static_cast<std::size_t>(step.first)].frame,
                             r.aligned_pairs[static_cast<std::size_t>(step.last)].frame,
                             step.*error});
  return series;
}

/// Mean of 100 / L over the segments: an error at their ends in percent of their lengths.
double percent_per_m(const std::vector<SegmentError>& segments) {
  double sum = 0;
  for (const SegmentError& segment : segments) sum += 100 / segment.length_m;
  return segments.empty() ? 0 : sum / static_cast<double>(segments.size());
}

/// The figures whose errors lie along the drive.
std::vector<FigureSeries> series_of(const EvaluationResult& r) {
  std::vector<FigureSeries> all;
  if (!r.outcome) return all;
  if (r.segments.outcome) {
    all.push_back({"t_rel_percent", "t_rel", "%", SeriesFigure::kMean,
                   translation_series(r.segments.segments)});
    all.push_back({"r_rel_deg_per_100m", "r_rel", "deg/100m", SeriesFigure::kMean,
                   rotation_series(r.segments.segments)});
  }
  const auto add = [&](const RelativeErrors& steps, const std::string& key,
                       const std::string& over) {
    if (!steps.outcome) return;
    all.push_back({key + "_trans_m", "RPE trans" + over, "m", SeriesFigure::kRmse,
                   {steps_of(r, steps, &RelativeError::translation_m)}});
    all.push_back({key + "_rot_deg", "RPE rot" + over, "deg", SeriesFigure::kRmse,
                   {steps_of(r, steps, &RelativeError::rotation_deg)}});
  };
  add(r.rpe, "rpe", "");
  for (const RelativeErrors& steps : r.relative)
    add(steps, "rpe_" + to_string(steps.delta), " over " + to_string(steps.delta));
  return all;
}

ConfidenceInterval one_run(double value) {
  ConfidenceInterval interval;
  interval.estimate = value;
  interval.of = "repeated runs";
  interval.outcome = Outcome::failure(Outcome::Code::kTooFewData, "one run");
  return interval;
}

Json interval_json(const ConfidenceInterval& interval) {
  Json json;
  json["estimate"] = interval.estimate;
  json["low"] = interval.outcome ? Json(interval.low) : Json(nullptr);
  json["high"] = interval.outcome ? Json(interval.high) : Json(nullptr);
  json["level"] = interval.level;
  json["of"] = interval.of;
  if (!interval.outcome) json["reason"] = interval.outcome.reason;
  return json;
}

/// Figures that are errors: positive, and smaller is better.
bool is_error(const Metric& metric) {
  return !is_share_of_drive(metric.key) && !metric.key.starts_with("scale_drift");
}

}  // namespace

std::vector<FigureInterval> intervals_of_drive(const EvaluationResult& result, double level) {
  std::vector<FigureInterval> intervals;
  if (result.outcome && result.ape.outcome)
    intervals.push_back({"ate_rmse_m", "ATE RMSE", "m", one_run(result.ape.error_m.rmse)});
  for (const FigureSeries& each : series_of(result))
    intervals.push_back({each.key, each.name, each.unit,
                         each.figure == SeriesFigure::kMean
                             ? interval_of_mean(each.series, level)
                             : interval_of_rmse(each.series, level)});
  return intervals;
}

std::vector<FigureInterval> intervals_of_repeated_runs(const std::vector<EvaluationResult>& runs,
                                                       double level) {
  std::vector<FigureInterval> intervals;
  const auto good = std::find_if(runs.begin(), runs.end(),
                                 [](const EvaluationResult& run) { return bool(run.outcome); });
  if (good == runs.end()) return intervals;
  for (const Metric& metric : metrics(*good)) {
    if (!is_error(metric)) continue;
    std::vector<double> values;
    for (const EvaluationResult& run : runs)
      for (const Metric& own : metrics(run))
        if (own.key == metric.key && own.value) values.push_back(*own.value);
    if (values.empty()) continue;
    FigureInterval figure{metric.key, metric.name, metric.unit, interval_of_runs(values, level)};
    if (values.size() < runs.size())
      figure.interval.outcome = Outcome::failure(
          Outcome::Code::kInconsistent,
          fmt::format("{} of {} runs have no such figure", runs.size() - values.size(),
                      runs.size()));
    intervals.push_back(std::move(figure));
  }
  return intervals;
}

std::map<std::string, double> noise_floors(const EvaluationResult& result,
                                           const TruthNoise& noise) {
  std::map<std::string, double> floors;
  if (!result.outcome || !noise.outcome) return floors;
  const double m = noise.sigma.head<3>().norm(), deg = rad_to_deg(noise.sigma.tail<3>().norm());
  if (result.ape.outcome) floors["ate_rmse_m"] = m;
  if (result.ape.rotation_outcome) floors["are_rmse_deg"] = deg;
  // Both ends of a step or segment err.
  const double ends = std::sqrt(2.0);
  if (result.segments.outcome) {
    const double per_m = percent_per_m(result.segments.segments);
    floors["t_rel_percent"] = ends * m * per_m;
    floors["r_rel_deg_per_100m"] = ends * deg * per_m;
  }
  const auto add = [&](const RelativeErrors& steps, const std::string& key) {
    if (!steps.outcome) return;
    floors[key + "_trans_m"] = ends * m;
    floors[key + "_rot_deg"] = ends * deg;
  };
  add(result.rpe, "rpe");
  for (const RelativeErrors& steps : result.relative) add(steps, "rpe_" + to_string(steps.delta));
  return floors;
}

std::vector<FigureComparison> compare_estimates(const EvaluationResult& first,
                                                const EvaluationResult& second,
                                                const TruthNoise& noise, double level) {
  std::vector<FigureComparison> all;
  const std::vector<FigureSeries> others = series_of(second);
  std::map<std::string, double> floors = noise_floors(first, noise);
  for (const FigureSeries& own : series_of(first))
    for (const FigureSeries& other : others) {
      if (other.key != own.key) continue;
      ComparisonOptions options;
      options.level = level;
      options.noise_floor = floors[own.key];
      options.first = first.name;
      options.second = second.name;
      options.figure = own.name;
      options.unit = own.unit;
      all.push_back({own.key, compare_series(own.series, other.series, own.figure, options)});
    }
  return all;
}

std::vector<std::vector<FigureComparison>> compare_with_first(
    const std::vector<EvaluationResult>& results, double level) {
  require(!results.empty(), "no estimate to compare");
  Trajectory truth;
  truth.has_times = results.front().has_times;
  for (const FramePair& pair : results.front().aligned_pairs)
    truth.poses.push_back({pair.stamp_ns, pair.T_world_truth});
  const TruthNoise noise = estimate_truth_noise(truth);
  std::vector<std::vector<FigureComparison>> comparisons;
  for (std::size_t i = 1; i < results.size(); ++i)
    comparisons.push_back(compare_estimates(results.front(), results[i], noise, level));
  return comparisons;
}

std::string to_text(const std::vector<FigureInterval>& intervals) {
  std::string text;
  std::size_t width = 0;
  const auto named = [](const FigureInterval& figure) {
    return fmt::format("{} [{}]", figure.name, figure.unit);
  };
  for (const FigureInterval& each : intervals) width = std::max(width, named(each).size());
  for (const FigureInterval& each : intervals)
    text += fmt::format("  {:<{}}  {}\n", named(each), width, to_text(each.interval));
  return text;
}

std::string to_text(const std::vector<FigureComparison>& comparisons) {
  std::string text;
  for (const FigureComparison& each : comparisons) text += "  " + each.comparison.sentence + "\n";
  return text;
}

std::string to_json(const std::vector<FigureInterval>& intervals) {
  Json json = Json::object();
  for (const FigureInterval& each : intervals) json[each.key] = interval_json(each.interval);
  return json.dump();
}

std::string to_json(const std::vector<FigureComparison>& comparisons) {
  Json json = Json::object();
  for (const auto& [key, comparison] : comparisons) {
    Json row;
    row["first"] = comparison.first;
    row["second"] = comparison.second;
    row["ratio"] = interval_json(comparison.ratio);
    row["p_value"] = comparison.outcome ? Json(comparison.p_value) : Json(nullptr);
    row["difference"] = to_string(comparison.difference);
    row["sentence"] = comparison.sentence;
    json[key] = row;
  }
  return json.dump();
}

}  // namespace placegraph
