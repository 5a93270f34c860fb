#include <placegraph/eval/trajectory/figure_intervals.h>

#include <limits>

#include "python/src/arrays.h"
#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Columns of intervals, NaN and the reason where there is none.
Table interval_table(const std::vector<FigureInterval>& intervals) {
  std::vector<std::string> key, unit, of, reason;
  std::vector<double> estimate, low, high, level;
  for (const FigureInterval& each : intervals) {
    const ConfidenceInterval& interval = each.interval;
    key.push_back(each.key);
    unit.push_back(each.unit);
    of.push_back(interval.of);
    reason.push_back(interval.outcome.reason);
    estimate.push_back(interval.estimate);
    low.push_back(interval.outcome ? interval.low : kUnknown);
    high.push_back(interval.outcome ? interval.high : kUnknown);
    level.push_back(interval.level);
  }
  const std::size_t n = key.size();
  Table table;
  table["figure"] = key;
  table["unit"] = unit;
  table["estimate"] = owned_array(std::move(estimate), {n});
  table["low"] = owned_array(std::move(low), {n});
  table["high"] = owned_array(std::move(high), {n});
  table["level"] = owned_array(std::move(level), {n});
  table["of"] = of;
  table["reason"] = reason;
  return table;
}

/// Columns of the comparisons of each further estimate with the first.
Table comparison_table(const std::vector<EvaluationResult>& results, double level) {
  std::vector<std::string> name, key, difference, sentence;
  std::vector<double> first, second, ratio, low, high, p;
  std::size_t of = 0;
  for (const std::vector<FigureComparison>& figures : compare_with_first(results, level)) {
    ++of;
    for (const auto& [figure, comparison] : figures) {
      const bool known = bool(comparison.outcome);
      name.push_back(results[of].name);
      key.push_back(figure);
      first.push_back(comparison.first);
      second.push_back(comparison.second);
      ratio.push_back(known ? comparison.ratio.estimate : kUnknown);
      low.push_back(known ? comparison.ratio.low : kUnknown);
      high.push_back(known ? comparison.ratio.high : kUnknown);
      p.push_back(known ? comparison.p_value : kUnknown);
      difference.emplace_back(to_string(comparison.difference));
      sentence.push_back(comparison.sentence);
    }
  }
  const std::size_t n = name.size();
  Table table;
  table["name"] = name;
  table["figure"] = key;
  table["first"] = owned_array(std::move(first), {n});
  table["second"] = owned_array(std::move(second), {n});
  table["ratio"] = owned_array(std::move(ratio), {n});
  table["low"] = owned_array(std::move(low), {n});
  table["high"] = owned_array(std::move(high), {n});
  table["p_value"] = owned_array(std::move(p), {n});
  table["difference"] = difference;
  table["sentence"] = sentence;
  return table;
}

}  // namespace

void bind_intervals(nb::module_& m) {
  m.def(
      "intervals_of_drive",
      [](const EvaluationResult& result, double level) {
        return interval_table(intervals_of_drive(result, level));
      },
      "result"_a, "level"_a = 0.95, doc("intervals_of_drive"));
  m.def(
      "intervals_of_repeated_runs",
      [](const std::vector<EvaluationResult>& runs, double level) {
        return interval_table(intervals_of_repeated_runs(runs, level));
      },
      "runs"_a, "level"_a = 0.95, doc("intervals_of_repeated_runs"));
  m.def("compare_with_first", &comparison_table, "results"_a, "level"_a = 0.95,
        doc("compare_with_first"));
}

}  // namespace placegraph::python
