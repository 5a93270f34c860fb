#include <gtest/gtest.h>
#include <placegraph/backend/factor_graph/bundle_adjustment.h>
#include <placegraph/io/graphs/bal.h>

#include "tests/support/data.h"

namespace placegraph {
namespace bundle_adjustment_test {

TEST(BundleAdjustment, ReachesTheKnownMinimumOfLadybug) {
  PLACEGRAPH_DATA_OR_SKIP(path, "bal/problem-49-7776-pre.txt");
  const Bundle start = read_bal(path);
  ASSERT_EQ(start.observations.size(), 31843u);
  const BundleReport report = adjust_bundle(start, {});
  EXPECT_TRUE(report.outcome) << report.outcome.reason;
  EXPECT_NEAR(report.cost_initial, 850912.5, 1);
  EXPECT_LE(report.cost_final, 13344.25 * (1 + 1e-4)) << report.iterations << " iterations";
  RecordProperty("iterations", report.iterations);
}

}  // namespace bundle_adjustment_test
}  // namespace placegraph
