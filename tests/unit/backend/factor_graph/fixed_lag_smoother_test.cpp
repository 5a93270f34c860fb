#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/backend/factor_graph/fixed_lag_smoother.h>
#include <placegraph/backend/factors/linear_prior.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <limits>
#include <stdexcept>

#include "tests/support/factor_check.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace fixed_lag_smoother_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// r = (x - measured) / sigma.
class Measured final : public SizedFactor<1, double> {
 public:
  Measured(double measured, double sigma) : measured_(measured), sigma_(sigma) {}
  bool compute(const double& x, Residual& r, Jacobians* J) const override {
    r[0] = (x - measured_) / sigma_;
    if (J) std::get<0> (*J)(0, 0) = 1 / sigma_;
    return true;
  }

 private:
  double measured_, sigma_;
};

/// r = (b - a - measured) / sigma.
class Difference final : public SizedFactor<1, double, double> {
 public:
  Difference(double measured, double sigma) : measured_(measured), sigma_(sigma) {}
  bool compute(const double& a, const double& b, Residual& r, Jacobians* J) const override {
    r[0] = (b - a - measured_) / sigma_;
    if (!J) return true;
    std::get<0> (*J)(0, 0) = -1 / sigma_;
    std::get<1> (*J)(0, 0) = 1 / sigma_;
    return true;
  }

 private:
  double measured_, sigma_;
};

/// Throws wherever it is evaluated.
class Throws final : public SizedFactor<1, double> {
 public:
  bool compute(const double&, Residual&, Jacobians*) const override {
    throw std::runtime_error("of the factor");
  }
};

constexpr FactorGraphOptions kExact = {.max_iterations = 100, .relative_decrease = 1e-15};

TEST(FixedLagSmoother, EqualsTheBatchSolutionOfALinearProblem) {
  Random random = test::seeded_random(11);
  FixedLagSmoother smoother(5, kExact);
  FactorGraph batch;
  for (int i = 0; i < 40; ++i) {
    ASSERT_EQ(smoother.add_variable(i, 3.0 * random.normal()), i);
    batch.add_variable(0.0);
    const auto add = [&](const auto& factor, const std::vector<int>& between) {
      smoother.add(factor, between);
      batch.add(factor, between);
    };
    if (i % 7 == 0) add(Measured(random.normal(), 0.5), {i});
    if (i > 0) add(Difference(random.normal(), 0.1), {i - 1, i});
    if (i > 3) add(Difference(random.normal(), 0.3), {i - 4, i});
    const FixedLagStep step = smoother.update();
    ASSERT_TRUE(step.outcome) << step.outcome.reason;
  }
  const FactorGraphReport expected = optimize_factor_graph(batch, kExact);
  EXPECT_THAT(smoother.variables(), ElementsAre(34, 35, 36, 37, 38, 39));
  for (const int i : smoother.variables())
    EXPECT_NEAR(std::get<double>(smoother.value(i)), expected.graph.value<double>(i), 1e-7) << i;
  const MarginalCovariance joint = smoother.covariance({39, 35});
  const MarginalCovariance of_batch = marginal_covariance(expected.graph, {39, 35});
  ASSERT_TRUE(joint.outcome) << joint.outcome.reason;
  EXPECT_LT((joint.covariance - of_batch.covariance).norm(), 1e-10);
}

TEST(FixedLagSmoother, FollowsTheBatchSolutionOfADrive) {
  Random random = test::seeded_random(12);
  const auto noise = [&](double size) {
    SE3::Tangent xi;
    for (double& value : xi) value = size * random.normal();
    return SE3::exp(xi);
  };
  const Eigen::Matrix<double, 6, 6> W = 100 * Eigen::Matrix<double, 6, 6>::Identity();
  const SE3 step(SO3::exp({0, 0.05, 0.01}), Eigen::Vector3d(0, 0, 1));
  FixedLagSmoother smoother(8, kExact);
  FactorGraph batch;
  SE3 start;
  for (int i = 0; i < 60; ++i) {
    smoother.add_variable(i, start * noise(0.05));
    batch.add_variable(start);
    const auto add = [&](const auto& factor, const std::vector<int>& between) {
      smoother.add(factor, between);
      batch.add(factor, between);
    };
    if (i == 0) add(PosePriorFactor<SE3>(SE3(), W), {0});
    SE3 measured;
    for (int back = 1; back <= 3; ++back) {
      measured = measured * step;
      if (i >= back) add(RelativePoseFactor<SE3>(measured * noise(0.01), W), {i - back, i});
    }
    ASSERT_TRUE(smoother.update().outcome);
    start = std::get<SE3>(smoother.value(i)) * step;
  }
  const FactorGraphReport expected = optimize_factor_graph(batch, kExact);
  for (const int i : smoother.variables()) {
    const SE3& batch_pose = expected.graph.value<SE3>(i);
    const SE3::Tangent e = VariableBlock<SE3>::minus(std::get<SE3>(smoother.value(i)), batch_pose);
    const MarginalCovariance of_batch = marginal_covariance(expected.graph, {i});
    ASSERT_TRUE(of_batch.outcome) << of_batch.outcome.reason;
    // A tenth of a standard deviation: what the linearization of the prior costs.
    EXPECT_LT(e.dot(of_batch.covariance.llt().solve(e)), 0.1 * 0.1) << i;
  }
}

TEST(FixedLagSmoother, KeepsWhatIsTouchedAndDropsWhatIsHeld) {
  FixedLagSmoother smoother(1, kExact);
  const int held = smoother.add_variable(0, 2.0, true);
  const int landmark = smoother.add_variable(0, 0.0);
  smoother.add(Difference(3, 1), {held, landmark});
  const int late = smoother.add_variable(5, 0.0);
  smoother.add(Difference(1, 1), {landmark, late});
  smoother.touch(landmark, 4.5);
  EXPECT_THAT(smoother.update().marginalized, ElementsAre(held));
  EXPECT_THAT(smoother.variables(), ElementsAre(landmark, late));
  EXPECT_NEAR(std::get<double>(smoother.value(landmark)), 5, 1e-6);
  EXPECT_NEAR(std::get<double>(smoother.value(late)), 6, 1e-6);
  EXPECT_NEAR(smoother.covariance({late}).covariance(0, 0), 2, 1e-9);
  EXPECT_THROW((void)smoother.value(held), ArgumentError);
  EXPECT_THROW(smoother.add(Measured(1, 1), {held}), ArgumentError);
}

TEST(FixedLagSmoother, LeavesNoPriorWhereTheTermsTellNothing) {
  FixedLagSmoother smoother(0, kExact);
  smoother.add_variable(0, 1.0);
  smoother.add_variable(1, 3.0);
  smoother.add(Difference(1, 1e-3), {0, 1});  // the place of both is free
  EXPECT_THAT(smoother.update().marginalized, ElementsAre(0));
  EXPECT_THAT(smoother.window().terms, IsEmpty());
}

TEST(FixedLagSmoother, DropsVariablesThatShareNoTerm) {
  FixedLagSmoother smoother(1, kExact);
  for (int i = 0; i < 4; ++i) {
    smoother.add_variable(i, 0.0);
    if (i != 1) smoother.add(Measured(i, 1), {i});
    EXPECT_EQ(smoother.update().marginalized.size(), i < 2 ? 0u : 1u) << i;
  }
  EXPECT_THAT(smoother.variables(), ElementsAre(2, 3));
  EXPECT_NEAR(std::get<double>(smoother.value(3)), 3, 1e-9);
}

TEST(LinearPriorFactor, HasTheDerivativesOfEveryKindOfVariable) {
  Random random = test::seeded_random(13);
  const auto normal = [&](Eigen::Index rows, Eigen::Index columns, double size) {
    Eigen::MatrixXd values(rows, columns);
    for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = size * random.normal();
    return values;
  };
  const std::vector<Variable> at = {2.0,
                                    SE2(1, 2, 0.3),
                                    SE3(SO3::exp({0.1, 0.2, 0.3}), Eigen::Vector3d(1, 2, 3)),
                                    Sim3(SO3::exp({0.3, 0.1, 0}), Eigen::Vector3d(1, 0, 3), 1.5),
                                    SO3::exp({0.3, 0.1, 0.5}),
                                    Eigen::Vector3d(1, 2, 3),
                                    Line3::from_direction({1, 2, 3}, {0, 1, 1}),
                                    Plane3({0, 1, 0.1}, 2),
                                    Marker{SE3(), 0.2}};
  std::vector<Variable> values;
  Eigen::Index columns = 0;
  for (const Variable& point : at) {
    values.push_back(plus(point, normal(degrees_of_freedom(point), 1, 0.3)));
    columns += degrees_of_freedom(point);
  }
  const LinearPriorFactor factor(at, normal(5, columns, 1), normal(5, 1, 1));
  test::expect_jacobians_match(factor, values);
}

TEST(FixedLagSmoother, RefusesWrongArgumentsAndStaysAsItIs) {
  EXPECT_THROW(FixedLagSmoother(-1), ArgumentError);
  EXPECT_THROW(FixedLagSmoother(1, {.max_iterations = 0}), ArgumentError);
  FixedLagSmoother smoother(1);
  EXPECT_THROW(smoother.add_variable(std::numeric_limits<double>::infinity(), 1.0), ArgumentError);
  smoother.add_variable(0, 1.0);
  EXPECT_THROW(smoother.add(Difference(1, 1), {0, 0}), ArgumentError);
  EXPECT_THROW(smoother.add(Difference(1, 1), {0}), ArgumentError);
  EXPECT_THROW(smoother.add(Measured(1, 1), {1}), ArgumentError);
  EXPECT_THROW(smoother.touch(1, 1), ArgumentError);
  EXPECT_THAT(smoother.window().terms, IsEmpty());
}

TEST(FactorGraph, ThrowsTheExceptionOfAFactorOrOfTheLog) {
  FactorGraph graph;
  graph.add(Measured(1, 1), {graph.add_variable(0.0)});
  const LogSink sink = [](LogLevel, const std::string&) { throw std::domain_error("of the log"); };
  EXPECT_THROW((void)optimize_factor_graph(graph, {}, sink), std::domain_error);
  graph.add(Throws(), {graph.add_variable(0.0)});
  EXPECT_THROW((void)optimize_factor_graph(graph, {}), std::runtime_error);
  EXPECT_THROW((void)marginal_covariance(graph, {1}), std::runtime_error);
}

}  // namespace fixed_lag_smoother_test
}  // namespace placegraph
