#include <gtest/gtest.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <cmath>
#include <limits>

namespace placegraph {
namespace robust_kernel_test {

using Kind = RobustKernel::Kind;

class EveryKernel : public testing::TestWithParam<int> {
 protected:
  RobustKernel kernel(double width) const { return {static_cast<Kind>(GetParam()), width}; }
};

TEST_P(EveryKernel, IsLeastSquaresForSmallErrors) {
  for (const double width : {0.3, 1.0, 5.0}) {
    const auto value = kernel(width).evaluate(0);
    EXPECT_EQ(value.rho, 0);
    EXPECT_EQ(value.first, 1);
    EXPECT_NEAR(kernel(width).evaluate(1e-8).rho, 1e-8, 1e-14);
  }
}

TEST_P(EveryKernel, DerivativesAgreeWithFiniteDifferences) {
  for (const double width : {0.3, 1.0, 5.0})
    for (const double relative : {0.01, 0.3, 0.9, 1.1, 2.0, 30.0}) {
      const double s = relative * width * width, h = 1e-4 * s;
      const auto value = kernel(width).evaluate(s);
      const auto before = kernel(width).evaluate(s - h), after = kernel(width).evaluate(s + h);
      // Truncation of order (h / s)^2 = 1e-8 of the quantity, rounding 1e-16 / 1e-4.
      EXPECT_NEAR((after.rho - before.rho) / (2 * h), value.first, 1e-7);
      EXPECT_NEAR((after.first - before.first) / (2 * h), value.second, 1e-7 / s);
    }
}

TEST_P(EveryKernel, GrowsEverSlowerAndNeverAboveLeastSquares) {
  const RobustKernel k = kernel(1.5);
  auto last = k.evaluate(0);
  for (double s = 0.01; s < 1e4; s *= 1.1) {
    const auto value = k.evaluate(s);
    EXPECT_GE(value.rho, last.rho * (1 - 1e-12)) << s;
    EXPECT_LE(value.rho, s * (1 + 1e-12)) << s;
    EXPECT_LE(value.first, last.first + 1e-15) << s;
    EXPECT_GE(value.first, 0) << s;
    EXPECT_LE(value.second, 0) << s;
    last = value;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKernel,
                         testing::Range(0, static_cast<int>(robust_kernel_names().size())),
                         [](const auto& kind) { return robust_kernel_names()[kind.param]; });

TEST(RobustKernel, HasOneNameForEveryKind) {
  EXPECT_EQ(robust_kernel_names().size(), static_cast<std::size_t>(Kind::kTruncated) + 1);
}

TEST(RobustKernel, ValuesByHand) {
  EXPECT_DOUBLE_EQ((RobustKernel{Kind::kHuber, 2}.evaluate(9).rho), 2 * 2 * 3 - 4);
  EXPECT_DOUBLE_EQ((RobustKernel{Kind::kCauchy, 2}.evaluate(4).rho), 4 * std::log(2));
  EXPECT_DOUBLE_EQ((RobustKernel{Kind::kTukey, 3}.evaluate(100).rho), 3);
  EXPECT_DOUBLE_EQ((RobustKernel{Kind::kGemanMcClure, 2}.evaluate(4).rho), 2);
  EXPECT_DOUBLE_EQ((RobustKernel{Kind::kDcs, 1}.evaluate(3).first), 0.25);  // (2 / (1 + 3))^2
  EXPECT_EQ((RobustKernel{Kind::kTruncated, 2}.evaluate(3.9).rho), 3.9);
  EXPECT_EQ((RobustKernel{Kind::kTruncated, 2}.evaluate(4.1).rho), 4);
  EXPECT_EQ((RobustKernel{Kind::kTruncated, 2}.evaluate(4.1).first), 0);
}

}  // namespace robust_kernel_test
}  // namespace placegraph
