#pragma once
#include <placegraph/eval/gate/figure_judge.h>

#include <string>
#include <vector>

namespace placegraph {

/// A test of one figure whose verdict waits for those of all others.
struct GateTest {
  std::size_t figure = 0;  ///< index of the figure it decides
  GateRule rule;
  Better better = Better::kSmaller;
  std::vector<double> before, after;  ///< of the runs, by size; or of the sequences, in pairs
  double floor = 0;                   ///< no difference up to this counts
  bool varies = true;                 ///< false: no run differs from another of its system
  double p_worse = 1;  ///< probability of such a worsening, or a larger one, of equal systems
  double p_better = 1;
};

/// Runs of each system that a test needs for the effect of its rule; 0: not known.
/// `tests` are those that are made at once. The scatter is that of the baseline, or of the
/// candidate where the baseline has too few runs.
int runs_needed_for(const GateTest& test, std::size_t tests, const GateOptions& options);

/// The test of a figure's runs. Its outcome fails if the rule cannot be decided by runs: too few,
/// or values of both signs.
Outcome test_runs(const FigurePair& pair, GateTest& test);
/// The test of a figure over sequences, in pairs.
Outcome test_pairs(const std::vector<FigurePair>& pairs, GateTest& test);

/// Which of the tests reject at `level` together (Holm 1979), by their p of being worse.
std::vector<bool> rejected(const std::vector<GateTest>& tests, double level);

/// Decides the figures of the tests.
void decide_tests(const std::vector<GateTest>& tests, const GateOptions& options,
                  std::vector<GateFigure>& figures);

}  // namespace placegraph
