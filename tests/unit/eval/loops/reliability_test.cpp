#include <gtest/gtest.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace reliability_test {

TEST(Reliability, CountsByTenthsAndWeighsByAnswers) {
  // Four of 0.9, three of them right; one of 0.1 that is wrong.
  const Reliability r =
      reliability_of({{0.9, true}, {0.9, true}, {0.9, false}, {0.9, true}, {0.1, false}});
  ASSERT_EQ(r.bins.size(), 10u);
  EXPECT_EQ(r.bins[9].predictions, 4);
  EXPECT_NEAR(r.bins[9].share_right, 0.75, 1e-12);
  EXPECT_NEAR(r.bins[1].mean_probability, 0.1, 1e-12);
  EXPECT_NEAR(r.calibration_error, 0.8 * 0.15 + 0.2 * 0.1, 1e-12);
}

TEST(Reliability, CertaintyBelongsToTheLastTenth) {
  const Reliability r = reliability_of({{1, true}, {0, false}});
  EXPECT_EQ(r.bins[9].predictions, 1);
  EXPECT_EQ(r.bins[0].predictions, 1);
  EXPECT_EQ(r.calibration_error, 0);
  EXPECT_EQ(reliability_of({}).calibration_error, 0);
}

TEST(Reliability, RefusesWhatIsNoProbability) {
  EXPECT_THROW((void)reliability_of({{1.5, true}}), ArgumentError);
  EXPECT_THROW((void)reliability_of({{-0.1, true}}), ArgumentError);
}

}  // namespace reliability_test
}  // namespace placegraph
