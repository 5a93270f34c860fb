#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_terms.h>

#include <cmath>

#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace incremental_terms_test {

template <class Group>
class IncrementalTermsOf : public testing::Test {
 protected:
  static constexpr double kStep = 1e-5;

  Random random{1};
  Group T_world_from = test::random_element<Group>(random, 2, 1),
        T_world_to = T_world_from * test::random_element<Group>(random, 1, 0.5);

  /// Its measurement is some way off, so that the kernel matters.
  EdgeTerm<Group> term(RobustKernel::Kind kind) {
    EdgeTerm<Group> term;
    term.edge = {
        0,
        1,
        0,
        true,
        test::random_element<Group>(random, 0.3, 0.3) * T_world_to.inverse() * T_world_from,
        test::random_information<typename Group::Jacobian>(random),
        {kind, 1.5},
        0.7};
    return term;
  }
  double cost(EdgeTerm<Group> term, const typename Group::Tangent& at_from,
              const typename Group::Tangent& at_to) const {
    term.evaluate(T_world_from.plus(at_from), T_world_to.plus(at_to), RotationError::kLog);
    return term.cost;
  }
};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(IncrementalTermsOf, Groups);

TYPED_TEST(IncrementalTermsOf, HaveHalfTheDerivativesOfTheCost) {
  using Tangent = typename TypeParam::Tangent;
  for (const auto kind :
       {RobustKernel::Kind::kNone, RobustKernel::Kind::kHuber, RobustKernel::Kind::kCauchy}) {
    EdgeTerm<TypeParam> term = this->term(kind);
    term.evaluate(this->T_world_from, this->T_world_to, RotationError::kLog);
    for (int i = 0; i < TypeParam::kDof; ++i) {
      const Tangent zero = Tangent::Zero(), xi = Tangent::Unit(i) * TestFixture::kStep;
      const double by_from = this->cost(term, xi, zero) - this->cost(term, -xi, zero);
      const double by_to = this->cost(term, zero, xi) - this->cost(term, zero, -xi);
      // The differences are good to the square of the step and to rounding over the step.
      const double tolerance = 1e-8 * (1 + term.g_from.norm());
      EXPECT_NEAR(term.g_from[i], by_from / (4 * TestFixture::kStep), tolerance);
      EXPECT_NEAR(term.g_to[i], by_to / (4 * TestFixture::kStep), tolerance);
    }
  }
}

TYPED_TEST(IncrementalTermsOf, AreLinearizedToTheCurvatureWithTheWeightOfTheKernel) {
  using Jacobian = typename TypeParam::Jacobian;
  EdgeTerm<TypeParam> term = this->term(RobustKernel::Kind::kCauchy);
  EXPECT_LT(term.scale, 0) << "never linearized";
  const auto blocks = term.linearize(this->T_world_from, this->T_world_to, RotationError::kLog);
  term.evaluate(this->T_world_from, this->T_world_to, RotationError::kLog);
  EXPECT_EQ(term.change, 0);
  // Cauchy's cost is w c^2 log(1 + s / c^2), its weight w / (1 + s / c^2).
  const double b = 1.5 * 1.5;
  EXPECT_NEAR(term.scale, 0.7 * std::exp(-term.cost / (0.7 * b)), 1e-12);
  const Jacobian weighted = term.scale * term.edge.information;
  EXPECT_LT((blocks.from_from - term.J_from.transpose() * weighted * term.J_from).norm(), 1e-10);
  EXPECT_LT((blocks.from_to - term.J_from.transpose() * weighted * term.J_to).norm(), 1e-10);
  EXPECT_LT((blocks.to_to - term.J_to.transpose() * weighted * term.J_to).norm(), 1e-10);
}

TYPED_TEST(IncrementalTermsOf, ChangeWithTheErrorAndNotWithTheWorld) {
  EdgeTerm<TypeParam> term = this->term(RobustKernel::Kind::kNone);
  term.linearize(this->T_world_from, this->T_world_to, RotationError::kLog);
  const auto T_new_old = test::random_element<TypeParam>(this->random, 5, 2);
  term.evaluate(T_new_old * this->T_world_from, T_new_old * this->T_world_to, RotationError::kLog);
  EXPECT_LT(term.change, 1e-10);
  const typename TypeParam::Tangent xi = TypeParam::Tangent::Constant(0.1);
  double before = 0;
  for (const double size : {0.01, 0.1, 1.0}) {
    term.evaluate(this->T_world_from, this->T_world_to.plus(size * xi), RotationError::kLog);
    EXPECT_GT(term.change, 3 * before) << "about linear in the motion";
    before = term.change;
  }
  // Twice the weight is a change by half, and no weight a change of all.
  term.edge.weight *= 2;
  term.evaluate(this->T_world_from, this->T_world_to, RotationError::kLog);
  EXPECT_NEAR(term.change, 0.5, 1e-10);
  term.edge.weight = 0;
  term.evaluate(this->T_world_from, this->T_world_to, RotationError::kLog);
  EXPECT_EQ(term.change, 1);
  EXPECT_EQ(term.cost, 0);
  EXPECT_TRUE(term.g_from.isZero(0) && term.g_to.isZero(0));
}

TYPED_TEST(IncrementalTermsOf, OfAPositionHaveGradientAndCurvature) {
  using Tangent = typename TypeParam::Tangent;
  PositionTerm<TypeParam> term;
  term.position = {0,
                   0,
                   {1, -2, 0.5},
                   {0.3, 0.4, 0},
                   test::random_information<Eigen::Matrix3d>(this->random),
                   {RobustKernel::Kind::kHuber, 0.5},
                   2};
  term.evaluate(this->T_world_from);
  const Tangent g = term.g;
  for (int i = 0; i < TypeParam::kDof; ++i) {
    const Tangent xi = Tangent::Unit(i) * TestFixture::kStep;
    term.evaluate(this->T_world_from.plus(xi));
    const double above = term.cost;
    term.evaluate(this->T_world_from.plus(-xi));
    EXPECT_NEAR(g[i], (above - term.cost) / (4 * TestFixture::kStep), 1e-7 * (1 + g.norm()));
  }
  // Where the error is zero the cost is the quadratic form of H alone.
  term.position.kernel = {};
  constexpr int dim = TypeParam::kDof == 3 ? 2 : 3;
  term.position.position_world.template head<dim>() =
      this->T_world_from * Eigen::Vector3d(0.3, 0.4, 0).template head<dim>();
  const auto H_0 = term.evaluate(this->T_world_from);
  EXPECT_LT(term.g.norm(), 1e-12);
  const Tangent xi = TestFixture::kStep * Tangent::LinSpaced(1, -2);
  term.evaluate(this->T_world_from.plus(xi));
  EXPECT_NEAR(term.cost, xi.dot(H_0 * xi), 1e-3 * term.cost);  // to a share of the step's size
}

}  // namespace incremental_terms_test
}  // namespace placegraph
