#include <gtest/gtest.h>
#include <placegraph/backend/solver/local_solver.h>
#include <placegraph/backend/solver/normal_equations.h>

namespace placegraph {
namespace normal_equations_test {

template <class Group>
class Observations : public testing::Test {
 protected:
  static constexpr int kDof = Group::kDof, kDim = Group::kDof == 3 ? 2 : 3;

  static Group point(double x, double y, double z) {
    typename Group::Tangent xi = Group::Tangent::Zero();
    xi.template head<kDim>() = Eigen::Vector3d(x, y, z).template head<kDim>();
    return Group::exp(xi);  // which does not turn
  }
  /// Two poses that see a point each, and one that both see.
  static PackedGraph<Group> graph() {
    typename Group::Tangent xi = Group::Tangent::LinSpaced(kDof, 0.4, -0.3);
    PackedGraph<Group> graph;
    graph.poses = {Group::exp(xi), Group::exp(2 * xi), point(3, 1, 2), point(-1, 2, 1),
                   point(1, -4, 0.5)};
    graph.components.held.assign(graph.poses.size(), 0);
    Eigen::Matrix3d information;
    information << 4, 1, 0.5, 1, 3, -0.2, 0.5, -0.2, 2;
    if (kDim == 2) information.row(2).setZero(), information.col(2).setZero();
    graph.observations = {{0, 2, {2, 1, 1}, information},
                          {0, 3, {-1, 1, 1}, 2 * information},
                          {1, 3, {-2, 2, 0}, information},
                          {1, 4, {0, -3, 0}, information}};
    return graph;
  }
};

using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(Observations, Groups);

TYPED_TEST(Observations, HaveTheGradientAndCurvatureOfFiniteDifferences) {
  using Group = TypeParam;
  constexpr int dof = TestFixture::kDof, dim = TestFixture::kDim;
  PackedGraph<Group> graph = TestFixture::graph();
  NormalEquations<Group> equations(graph);
  const double cost = equations.linearize(graph, RotationError::kLog);
  EXPECT_NEAR(cost, robust_cost(graph, RotationError::kLog), 1e-12 * cost);
  const Eigen::VectorXd gradient = equations.gradient();
  const std::vector<Group> at = graph.poses;
  constexpr double kStep = 1e-6;
  for (std::size_t node = 0; node < at.size(); ++node)
    for (int i = 0; i < dof; ++i) {
      const Eigen::Index k = static_cast<Eigen::Index>(node) * dof + i;
      Eigen::VectorXd dx = Eigen::VectorXd::Zero(gradient.size()), product;
      dx[k] = 1;
      equations.matrix().multiply(dx, product);
      if (node >= 2 && i >= dim) {  // a point does not turn
        EXPECT_EQ(gradient[k], 0);
        EXPECT_GT(product[k], 0);
        product[k] = 0;
        EXPECT_TRUE(product.isZero(0));
        continue;
      }
      double costs[2];
      for (const int side : {0, 1}) {
        graph.poses = at;
        equations.move(graph, (side ? kStep : -kStep) * dx);
        costs[side] = robust_cost(graph, RotationError::kLog);
      }
      EXPECT_NEAR((costs[1] - costs[0]) / (2 * kStep), 2 * gradient[k], 1e-6 * cost);
    }
}

TYPED_TEST(Observations, AreSolvedToTheLastWhereTheyAgree) {
  using Group = TypeParam;
  PackedGraph<Group> graph = TestFixture::graph();
  graph.components.held[0] = graph.components.held[1] = 1;
  // Every point is where one pose sees it.
  graph.observations.erase(graph.observations.begin() + 2);
  const LocalSolution solution = LocalSolver<Group>({}).solve(graph);
  EXPECT_TRUE(solution.outcome);
  EXPECT_GT(solution.cost_initial, 1);
  EXPECT_LT(solution.cost_final, 1e-12);
}

}  // namespace normal_equations_test
}  // namespace placegraph
