#include <fmt/format.h>
#include <placegraph/eval/gate/significance.h>
#include <placegraph/eval/uncertainty/comparison.h>
#include <placegraph/eval/uncertainty/run_interval.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

/// The effect by which runs are counted where the rule names none.
double effect_of(const GateRule& rule) {
  return rule.find > 0 ? rule.find : PowerOptions().worse;
}

/// The values as errors, of which the smaller are better, or nothing to compare them by.
Outcome to_errors(std::vector<double>& before, std::vector<double>& after, Better better) {
  for (std::vector<double>* values : {&before, &after})
    for (double& value : *values) {
      if (better == Better::kNearerZero) value = std::abs(value);
      if (value < 0)
        return Outcome::failure(Outcome::Code::kDegenerate,
                                "a test compares by ratios, and a value is negative");
    }
  std::ranges::sort(before);
  std::ranges::sort(after);
  return Outcome::ok();
}

bool constant(const std::vector<double>& sorted) {
  // Rounding of equal runs.
  return sorted.back() - sorted.front() <= 1e-12 * std::abs(sorted.back());
}

/// Fills both p of a comparison, in which `a` is the first system.
void take_p(const Comparison& comparison, Better better, GateTest& test) {
  const double worse = comparison.p_worse, other = 1 - comparison.p_worse;
  test.p_worse = better == Better::kLarger ? other : worse;
  test.p_better = better == Better::kLarger ? worse : other;
  if (better == Better::kEqual) {
    test.p_worse = comparison.p_value;
    test.p_better = 1;
  }
}

std::string unit_text(const GateFigure& figure) {
  return figure.unit.empty() ? "" : " " + figure.unit;
}

std::string p_text(double p) { return p < 1e-4 ? "p < 0.0001" : fmt::format("p = {:.2g}", p); }

std::string both_text(const GateTest& test, const GateFigure& figure) {
  return fmt::format("{} over {} {} and {}{} over {}, {}", figure.before_text, test.before.size(),
                     test.rule.over_sequences ? "sequences" : "runs", figure.after_text,
                     unit_text(figure), test.after.size(), p_text(test.p_worse));
}

void decide_found(const GateTest& test, GateFigure& figure) {
  const double difference = std::abs(*figure.after - *figure.before);
  if (test.floor > 0 && difference <= test.floor) {
    figure.standing = Standing::kWithin;
    figure.reason =
        fmt::format("the difference is within the noise of the truth, {}{}: {}",
                    number_text(test.floor), unit_text(figure), both_text(test, figure));
  } else {
    figure.standing = Standing::kRegressed;
    figure.reason = "worse by more than its scatter explains: " + both_text(test, figure);
  }
}

void decide_not_found(const GateTest& test, int needed, double level, GateFigure& figure) {
  const int runs = static_cast<int>(std::min(test.before.size(), test.after.size()));
  const bool too_few = !test.rule.over_sequences && runs < needed;
  const std::string finding = fmt::format("{:g} % worse would be found with {} runs of each",
                                          100 * effect_of(test.rule), needed);
  if (too_few) figure.runs_needed = needed;
  if (too_few && test.rule.find > 0) {
    figure.standing = Standing::kUnjudged;
    figure.reason = "too few runs: " + finding + "; " + both_text(test, figure);
    return;
  }
  figure.standing = figure.before == figure.after ? Standing::kSame
                    : test.p_better <= level      ? Standing::kImproved
                                                  : Standing::kWithin;
  figure.reason = "not worse by more than its scatter explains: " + both_text(test, figure);
  if (too_few) figure.reason += "; " + finding;
}

/// Runs that all repeat one computation: any difference is one of the systems.
void decide_constant(const GateTest& test, GateFigure& figure) {
  const double worse = worsening(test.better, *figure.before, *figure.after);
  const double allowed =
      std::max({test.rule.relative * std::abs(*figure.before), test.rule.absolute, test.floor});
  figure.standing = figure.before == figure.after ? Standing::kSame
                    : worse > allowed             ? Standing::kRegressed
                    : worse < -allowed            ? Standing::kImproved
                                                  : Standing::kWithin;
  figure.reason = "runs of one system do not differ: any difference is one of the systems";
}

}  // namespace

int runs_needed_for(const GateTest& test, std::size_t tests, const GateOptions& options) {
  PowerOptions power;
  power.worse = effect_of(test.rule);
  power.power = options.power;
  // The first of Holm's tests, the strictest; two-sided where either way is worse.
  power.level = options.level / static_cast<double>(std::max<std::size_t>(1, tests)) /
                (test.better == Better::kEqual ? 2 : 1);
  for (const std::vector<double>* values : {&test.before, &test.after}) {
    if (values->empty() || values->front() < 0) continue;
    const RunsNeeded needed = runs_needed(*values, power);
    if (needed.outcome) return needed.runs;
  }
  return 0;
}

Outcome test_runs(const FigurePair& pair, GateTest& test) {
  test.rule = pair.rule;
  test.better = pair.better();
  test.floor = pair.floor();
  test.before = pair.before.present();
  test.after = pair.after.present();
  if (const Outcome errors = to_errors(test.before, test.after, test.better); !errors)
    return errors;
  const std::size_t fewest = std::min(test.before.size(), test.after.size());
  if (fewest < static_cast<std::size_t>(kFewestRuns))
    return Outcome::failure(Outcome::Code::kTooFewData,
                            fmt::format("{} run{} of one: its scatter is not known", fewest,
                                        fewest == 1 ? "" : "s"));
  test.varies = !constant(test.before) || !constant(test.after);
  if (!test.varies) return Outcome::ok();
  const Comparison comparison = compare_runs(test.before, test.after);
  if (comparison.outcome) take_p(comparison, test.better, test);
  return comparison.outcome;
}

Outcome test_pairs(const std::vector<FigurePair>& pairs, GateTest& test) {
  test.rule = pairs.front().rule;
  test.better = pairs.front().better();
  for (const FigurePair& pair : pairs) {
    test.floor = std::max(test.floor, pair.floor());
    test.before.push_back(*pair.before.mean());
    test.after.push_back(*pair.after.mean());
    for (std::vector<double>* values : {&test.before, &test.after}) {
      if (test.better == Better::kNearerZero) values->back() = std::abs(values->back());
      if (values->back() <= 0)
        return Outcome::failure(Outcome::Code::kDegenerate,
                                "a test compares by ratios, and a value is not positive");
    }
  }
  const Comparison comparison = compare_paired_runs(test.before, test.after);
  if (comparison.outcome) take_p(comparison, test.better, test);
  return comparison.outcome;
}

std::vector<bool> rejected(const std::vector<GateTest>& tests, double level) {
  std::vector<std::size_t> order(tests.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&tests](std::size_t a, std::size_t b) { return tests[a].p_worse < tests[b].p_worse; });
  std::vector<bool> result(tests.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (tests[order[i]].p_worse > level / static_cast<double>(order.size() - i)) break;
    result[order[i]] = true;
  }
  return result;
}

void decide_tests(const std::vector<GateTest>& tests, const GateOptions& options,
                  std::vector<GateFigure>& figures) {
  std::vector<GateTest> uncertain;
  for (const GateTest& test : tests)
    if (test.varies)
      uncertain.push_back(test);
    else
      decide_constant(test, figures[test.figure]);
  const std::vector<bool> found = rejected(uncertain, options.level);
  for (std::size_t i = 0; i < uncertain.size(); ++i) {
    const GateTest& test = uncertain[i];
    if (found[i])
      decide_found(test, figures[test.figure]);
    else
      decide_not_found(test, runs_needed_for(test, uncertain.size(), options),
                       options.level / static_cast<double>(uncertain.size()),
                       figures[test.figure]);
  }
}

}  // namespace placegraph
