// What a gate's tests promise: alarms of equal systems, and the power at the runs it asks for.
#include <gtest/gtest.h>
#include <placegraph/eval/gate/gate.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/unit/eval/gate/gate_worlds.h"

namespace placegraph {
namespace gate_study_test {

using namespace gate_worlds;

/// Figures of runs about 1, with a relative scatter of about `scatter`.
using RunModel = std::function<double(Random&, double scatter)>;

double log_normal(Random& random, double scatter) { return std::exp(random.normal(0, scatter)); }
double normal(Random& random, double scatter) {
  return std::max(0.01, random.normal(1, std::min(scatter, 0.25)));
}
double uniform(Random& random, double scatter) {
  const double half = std::min(0.9, std::sqrt(3.0) * scatter);
  return random.uniform(1 - half, 1 + half);
}
/// The length of a vector of errors: an RMSE of a few independent ones.
double root_mean_square(Random& random, double /*scatter*/) {
  double squares = 0;
  for (int i = 0; i < 10; ++i) squares += std::pow(random.normal(), 2);
  return std::sqrt(squares / 10);
}
/// Most runs close a loop, one in five does not.
double two_modes(Random& random, double scatter) {
  return (random.index(5) == 0 ? 1 + 2 * scatter : 1) * std::exp(random.normal(0, scatter / 2));
}

const std::vector<std::pair<const char*, RunModel>>& models() {
  static const std::vector<std::pair<const char*, RunModel>> all = {
      {"log-normal", log_normal},
      {"normal", normal},
      {"uniform", uniform},
      {"root mean square", root_mean_square},
      {"two modes", two_modes}};
  return all;
}

Values draw(const RunModel& model, Random& random, double scatter, int runs, double factor = 1) {
  Values values;
  for (int run = 0; run < runs; ++run) values.emplace_back(factor * model(random, scatter));
  return values;
}

TEST(GateStudy, EqualSystemsAlarmInSixOfAHundredPairsAtMost) {
  // 2,000 pairs of each model; the deviation of 5 % of so many is 0.5 %.
  constexpr int kPairs = 2000;
  const GateRules rules = parse_rules("* | * | significant", "r");
  for (const auto& [name, model] : models()) {
    Random random(11);
    int alarms = 0;
    for (int pair = 0; pair < kPairs; ++pair) {
      const double scatter = random.uniform(0.03, 0.4);
      const int before = 5 + random.index(16), after = 5 + random.index(16);
      const int figures = 1 + random.index(5);
      std::vector<std::pair<std::string, Values>> a, b;
      for (int f = 0; f < figures; ++f) {
        a.emplace_back(std::to_string(f), draw(model, random, scatter, before));
        b.emplace_back(std::to_string(f), draw(model, random, scatter, after));
      }
      alarms += judge(record_of(a), record_of(b), rules).exit_code() == 1;
    }
    EXPECT_LE(alarms, 0.06 * kPairs) << name;
  }
}

TEST(GateStudy, TenPercentWorseIsFoundWithTheRunsItAsksFor) {
  constexpr int kTrials = 1000;
  const GateRules rules = parse_rules("* | * | significant 10 %", "r");
  for (const double scatter : {0.05, 0.1, 0.2})
    for (const auto& [name, model] : models()) {
      Random random(12);
      int found = 0;
      for (int trial = 0; trial < kTrials; ++trial) {
        // What a team has at first: ten runs of its baseline, and one of the candidate.
        const Record pilot = record_of({{"ate", draw(model, random, scatter, 10)}});
        const GateResult asked = judge(pilot, record_of({{"ate", {1.0}}}), rules);
        ASSERT_EQ(asked.exit_code(), 2);
        const int runs = asked.figures[0].runs_needed;
        const Record before = record_of({{"ate", draw(model, random, scatter, runs)}});
        const Record after = record_of({{"ate", draw(model, random, scatter, runs, 1.1)}});
        found += judge(before, after, rules).exit_code() == 1;
      }
      EXPECT_GE(found, 0.8 * kTrials) << name << " " << scatter;
    }
}

}  // namespace gate_study_test
}  // namespace placegraph
