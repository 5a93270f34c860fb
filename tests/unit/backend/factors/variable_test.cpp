#include <gtest/gtest.h>
#include <placegraph/backend/factors/variable.h>
#include <placegraph/backend/factors/variable_manifold.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/support/message_of.h"

namespace placegraph {
namespace variable_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One of every kind, in the order of the alternatives.
std::vector<Variable> one_of_each() {
  const SO3 R = SO3::exp({0.3, -0.5, 0.2});
  const Eigen::Vector3d t(1, -2, 0.5);
  return {0.7,
          SE2(1, 2, 0.5),
          SE3(R, t),
          Sim3(R, t, 1.5),
          R,
          t,
          Line3::from_direction(t, {1, 1, 3}),
          Plane3({1, 2, 2}, 3),
          Marker{SE3(R, t), 0.4}};
}

Eigen::VectorXd random_tangent(const Variable& x, Random& random) {
  Eigen::VectorXd xi(degrees_of_freedom(x));
  for (double& entry : xi) entry = random.uniform(-0.4, 0.4);
  return xi;
}

TEST(Variables, HaveTheNamesAndSizesOfTheirKinds) {
  const char* const names[] = {"scalar", "SE2",  "SE3",   "Sim3",  "rotation",
                               "point",  "line", "plane", "marker"};
  const int dofs[] = {1, 3, 6, 7, 3, 3, 4, 3, 6}, sizes[] = {1, 3, 7, 8, 4, 3, 5, 4, 8};
  const std::vector<Variable> variables = one_of_each();
  ASSERT_EQ(variables.size(), std::variant_size_v<Variable>);
  for (std::size_t kind = 0; kind < variables.size(); ++kind) {
    ASSERT_EQ(variables[kind].index(), kind);
    EXPECT_STREQ(kind_name(variables[kind]), names[kind]);
    EXPECT_EQ(degrees_of_freedom(variables[kind]), dofs[kind]) << names[kind];
    EXPECT_EQ(block_size(variables[kind]), sizes[kind]) << names[kind];
  }
}

TEST(Variables, MoveByATangentAndBack) {
  Random random(1);
  for (const Variable& x : one_of_each())
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::VectorXd xi = random_tangent(x, random);
      const Variable y = plus(x, xi);
      EXPECT_LT((minus(y, x) - xi).norm(), 1e-12) << kind_name(x);
      EXPECT_LT(minus(plus(y, minus(x, y)), x).norm(), 1e-12) << kind_name(x);
      EXPECT_LT(minus(plus(x, 0 * xi), x).norm(), 1e-15) << kind_name(x);
    }
}

TEST(Variables, AreStoredInTheirBlockAndNoFurther) {
  Random random(2);
  for (const Variable& x : one_of_each()) {
    std::vector<double> block(static_cast<std::size_t>(block_size(x)) + 1, kNan);
    store_block(x, block.data());
    EXPECT_TRUE(std::isnan(block.back())) << kind_name(x);
    for (int i = 0; i < block_size(x); ++i) EXPECT_TRUE(std::isfinite(block[i])) << kind_name(x);
    Variable loaded = plus(x, random_tangent(x, random));
    load_block(block.data(), loaded);
    EXPECT_EQ(loaded.index(), x.index());
    EXPECT_LT(minus(loaded, x).norm(), 1e-14) << kind_name(x);
  }
}

TEST(Variables, OfTwoKindsHaveNoDifferenceAndStepsHaveTheSizeOfTheTangent) {
  const std::vector<Variable> variables = one_of_each();
  for (const Variable& x : variables) {
    const std::string name = kind_name(x);
    for (const Variable& y : variables) {
      if (x.index() == y.index()) continue;
      const std::string message = test::message_of<ArgumentError>([&] { (void)minus(x, y); });
      EXPECT_NE(message.find(name + " and " + kind_name(y)), std::string::npos) << message;
    }
    for (const int off : {-1, 1}) {
      const Eigen::VectorXd step = Eigen::VectorXd::Zero(degrees_of_freedom(x) + off);
      const std::string message = test::message_of<ArgumentError>([&] { (void)plus(x, step); });
      EXPECT_NE(message.find("kind " + name), std::string::npos) << message;
    }
  }
}

TEST(Variables, AreFiniteIfAllTheirNumbersAre) {
  for (const Variable& x : one_of_each()) EXPECT_TRUE(is_finite(x)) << kind_name(x);
  EXPECT_FALSE(is_finite(kNan));
  EXPECT_FALSE(is_finite(Eigen::Vector3d(1, kInfinity, 2)));
  EXPECT_FALSE(is_finite(SE2(1, kNan, 0.5)));
  EXPECT_FALSE(is_finite(SE3(SO3(), Eigen::Vector3d(0, 0, -kInfinity))));
  EXPECT_FALSE(is_finite(Line3(SO3(), kNan)));
  EXPECT_FALSE(is_finite(Marker{SE3(), kInfinity}));
}

TEST(Variables, OfMarkersKeepTheSizeThatIsKnown) {
  const Marker marker{SE3(SO3(), Eigen::Vector3d(1, 2, 3)), 0.4};
  const Variable moved = plus(marker, Vector6d::Constant(0.2));
  EXPECT_EQ(std::get<Marker>(moved).size_m, 0.4);
}

/// The manifold of a kind does to blocks what [+] and [-] do to variables.
TEST(VariableManifolds, AreThoseOfTheVariables) {
  Random random(3);
  for (const Variable& x : one_of_each()) {
    SCOPED_TRACE(kind_name(x));
    std::visit(
        [&](const auto& value) {
          using T = std::decay_t<decltype(value)>;
          using Block = VariableBlock<T>;
          const VariableManifold<T> manifold;
          EXPECT_EQ(manifold.AmbientSize(), block_size(x));
          EXPECT_EQ(manifold.TangentSize(), degrees_of_freedom(x));
          const Eigen::VectorXd xi = random_tangent(x, random);
          double block[Block::kSize], moved[Block::kSize], back[Block::kDof];
          Block::store(value, block);
          EXPECT_TRUE(manifold.Plus(block, xi.data(), moved));
          EXPECT_LT(minus(Variable(Block::load(moved)), plus(x, xi)).norm(), 1e-14);
          EXPECT_TRUE(manifold.Minus(moved, block, back));
          for (int i = 0; i < Block::kDof; ++i) EXPECT_NEAR(back[i], xi[i], 1e-12);
          double plus_jacobian[Block::kSize * Block::kDof];
          EXPECT_TRUE(manifold.PlusJacobian(block, plus_jacobian));
          for (int row = 0; row < Block::kSize; ++row)
            for (int column = 0; column < Block::kDof; ++column)
              EXPECT_EQ(plus_jacobian[row * Block::kDof + column], row == column ? 1 : 0);
          Eigen::VectorXd broken = xi;
          broken[Block::kDof - 1] = kNan;
          EXPECT_FALSE(manifold.Plus(block, broken.data(), moved));
        },
        x);
  }
}

TEST(VariableManifolds, OfSimilaritiesKeepTheScaleANumberHoweverLongTheStep) {
  const VariableManifold<Sim3> manifold;
  double block[8], moved[8];
  VariableBlock<Sim3>::store(Sim3(SO3(), {1, 2, 3}, 2), block);
  for (const double sign : {-1.0, 1.0}) {
    Vector7d step = Vector7d::Zero();
    step[6] = sign * 1e6;
    EXPECT_TRUE(manifold.Plus(block, step.data(), moved));
    EXPECT_NEAR(std::log(moved[7]), std::log(2) + 20 * sign, 1e-12);
  }
}

}  // namespace variable_test
}  // namespace placegraph
