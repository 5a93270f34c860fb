#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/results/evo_archives.h>

#include <cmath>
#include <map>

#include "tests/support/message_of.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace evo_archives_test {

using test::message_of;
using testing::HasSubstr;

/// Statistics of errors whose values are known: the estimate stands off by 0, 1, 2, ... metres.
TEST(EvoArchives, AnEvaluationBecomesAResultOfEvo) {
  Trajectory truth = test::winding_drive(5), estimate = truth;
  for (std::size_t i = 0; i < 5; ++i)
    estimate.poses[i].T_world_body->translation().x() += static_cast<double>(i);
  EvaluationOptions options;
  options.alignment = Alignment::kNone;
  const EvoResult evo = evo_result_of(evaluate(truth, estimate, options, "est.tum"), "gt.tum");
  EXPECT_EQ(evo.title, "APE w.r.t. translation part (m)\n(not aligned)");
  EXPECT_EQ(evo.reference, "gt.tum");
  std::map<std::string, double> statistics(evo.statistics.begin(), evo.statistics.end());
  EXPECT_NEAR(statistics["rmse"], std::sqrt(6.0), 1e-12);
  EXPECT_NEAR(statistics["mean"], 2, 1e-12);
  EXPECT_NEAR(statistics["median"], 2, 1e-12);
  EXPECT_NEAR(statistics["std"], std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(statistics["min"], 0, 1e-12);
  EXPECT_NEAR(statistics["max"], 4, 1e-12);
  EXPECT_NEAR(statistics["sse"], 30, 1e-11);
  EXPECT_EQ(evo.arrays.at("error_array").rows, 5u);
  EXPECT_NEAR(evo.arrays.at("seconds_from_start").values[4], 0.4, 1e-9);
  EXPECT_EQ(evo.arrays.at("distances").values[0], 0);
  EXPECT_FALSE(evo.arrays.contains("alignment_transformation_sim3"));
  EXPECT_EQ(evo.trajectories.size(), 2u);
  EXPECT_TRUE(evo.trajectories.contains("est.tum.tum"));
  const SequenceFigures figures = figures_of_evo(evo, "00");
  EXPECT_EQ(figures.figures[0].key, "ape_m_rmse");
  EXPECT_EQ(figures.figures[0].name, "APE rmse");
  EXPECT_EQ(figures.figures[0].unit, "m");
  EXPECT_EQ(figures.figures[0].protocol, "APE w.r.t. translation part (m) (not aligned)");
}

TEST(EvoArchives, WhatWasNotEvaluatedIsNoResult) {
  EvaluationResult result;
  result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "one pair");
  EXPECT_THAT(message_of<NoResult>([&] { (void)evo_result_of(result, "gt"); }),
              HasSubstr("one pair"));
}

}  // namespace evo_archives_test
}  // namespace placegraph
