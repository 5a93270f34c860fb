#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/bearing.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/marker_corners.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/plane_orthogonal.h>
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/factor_check.h"
#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace factor_graph_test {

using Point = Eigen::Vector3d;

/// r = (x - measured) / sigma of a scalar or a point.
template <class T>
class Measured final : public SizedFactor<VariableBlock<T>::kDof, T> {
  using Base = SizedFactor<VariableBlock<T>::kDof, T>;

 public:
  Measured(const T& measured, double sigma) : measured_(measured), sigma_(sigma) {}
  bool compute(const T& x, typename Base::Residual& r, typename Base::Jacobians* J) const override {
    r = VariableBlock<T>::minus(x, measured_) / sigma_;
    if (J) std::get<0>(*J) = std::get<0>(*J).Identity() / sigma_;
    return true;
  }

 private:
  T measured_;
  double sigma_;
};

/// Cannot be computed anywhere.
class Never final : public SizedFactor<1, double> {
 public:
  bool compute(const double&, Residual&, Jacobians*) const override { return false; }
};

TEST(FactorGraph, WeighsTwoMeasurementsByTheirInformation) {
  FactorGraph graph;
  const int x = graph.add_variable(10.0);
  graph.add(Measured<double>(1, 0.5), {x});
  graph.add(Measured<double>(2, 1), {x});
  const FactorGraphReport report = optimize_factor_graph(graph, {});
  ASSERT_TRUE(report.outcome) << report.outcome.reason;
  EXPECT_NEAR(report.graph.value<double>(x), (1 * 4 + 2 * 1) / 5.0, 1e-6);
  // 0.4^2 + 0.8^2, halved
  EXPECT_NEAR(report.cost_final, 0.4, 1e-9);
  EXPECT_NEAR(report.cost_initial, 0.5 * (18 * 18 + 8 * 8), 1e-9);
  const MarginalCovariance marginal = marginal_covariance(report.graph, {x});
  ASSERT_TRUE(marginal.outcome) << marginal.outcome.reason;
  EXPECT_NEAR(marginal.covariance(0, 0), 1 / 5.0, 1e-12);
}

TEST(FactorGraph, LeavesWhatIsHeldAndWhatHasNoTerm) {
  FactorGraph graph;
  const int held = graph.add_variable(Point(1, 2, 3), true);
  const int alone = graph.add_variable(Plane3({0, 1, 0}, 2));
  const int free = graph.add_variable(Point(0, 0, 0));
  graph.add(Measured<Point>({7, 7, 7}, 1), {held});
  graph.add(Measured<Point>({4, 5, 6}, 1), {free});
  const FactorGraphReport report = optimize_factor_graph(graph, {});
  ASSERT_TRUE(report.outcome);
  EXPECT_EQ(report.graph.value<Point>(held), Point(1, 2, 3));
  EXPECT_EQ(report.graph.value<Plane3>(alone).distance(), graph.value<Plane3>(alone).distance());
  EXPECT_LT((report.graph.value<Point>(free) - Point(4, 5, 6)).norm(), 1e-9);
  const auto squares = squared_residuals(graph);
  EXPECT_EQ(*squares[0], 36 + 25 + 16);
}

TEST(FactorGraph, LetsAKernelSilenceAnOutlier) {
  FactorGraph graph;
  const int x = graph.add_variable(0.8);
  const RobustKernel kernel{RobustKernel::Kind::kTukey, 4};
  for (const double measured : {0.9, 1.0, 1.1, 25.0})
    graph.add(Measured<double>(measured, 0.1), {x}, kernel);
  const FactorGraphReport report = optimize_factor_graph(graph, {});
  ASSERT_TRUE(report.outcome);
  EXPECT_NEAR(report.graph.value<double>(x), 1, 1e-5);
}

/// A graph with every kind of variable, started off its truth.
struct Mixed {
  FactorGraph graph;
  std::vector<Variable> truth;

  int add(const Variable& value, double disturbance) {
    truth.push_back(value);
    Eigen::VectorXd step(degrees_of_freedom(value));
    for (Eigen::Index i = 0; i < step.size(); ++i) step[i] = disturbance * random_.normal();
    return graph.add_variable(plus(value, step), disturbance == 0);
  }
  template <class T>
  const T& of(int i) const {
    return std::get<T>(truth[static_cast<std::size_t>(i)]);
  }

  Mixed() {
    const Camera camera = test::window_camera();
    const int a = add(SE3(), 0);
    const int b = add(SE3(SO3::exp({0.02, 0.1, 0}), Point(1, 0, 0.5)), 0.02);
    const int c = add(SE3(SO3::exp({-0.02, -0.1, 0.05}), Point(-1, 0.2, 1)), 0.02);
    const int ground = add(Plane3({0.02, 1, 0.01}, 1.65), 0.05);
    const int wall = add(Plane3({1, -0.02, 0}, 4), 0.05);
    const int frame = add(SO3::exp({0, 0.3, 0}), 0.02);
    const int line = add(Line3::from_direction({2, 0.5, 7}, {0.2, 1, 0.3}), 0.02);
    const int marker = add(Marker{SE3(SO3::exp({3, 0.2, 0.1}), Point(-0.5, 0.3, 4)), 0.5}, 0.03);
    graph.add(PosePriorFactor<SE3>(of<SE3>(b), Matrix6d::Identity()), {b});
    graph.add(DistanceFactor((of<SE3>(b).translation() - of<SE3>(c).translation()).norm(), 0.01),
              {b, c});
    graph.add(BearingFactor(of<SE3>(b).translation(), 50 * Eigen::Matrix3d::Identity()), {a, b});
    graph.add(PlaneOrthogonalFactor(0.01), {ground, wall});
    for (const int camera_pose : {a, b, c}) {
      const SE3& T = of<SE3>(camera_pose);
      const double height = std::abs(of<Plane3>(ground).distance_to(T.translation()));
      graph.add(HeightAbovePlaneFactor(height, 0.01), {camera_pose, ground});
      for (const int plane : {ground, wall}) {
        const Plane3 seen = transform_to(T, of<Plane3>(plane));
        graph.add(PlaneObservationFactor(seen, whitening(plane_information(seen, 0.01, 0.02))),
                  {camera_pose, plane});
      }
      graph.add(AbsoluteRotationFactor(T.rotation().inverse() * of<SO3>(frame),
                                       100 * Eigen::Matrix3d::Identity()),
                {camera_pose, frame});
      const Line3& l = of<Line3>(line);
      graph.add(LineReprojectionFactor(
                    camera, *camera.project(T.inverse() * (l.nearest_point() - l.direction())),
                    *camera.project(T.inverse() * (l.nearest_point() + l.direction())), 0.5),
                {camera_pose, line});
      MarkerCornersFactor::Corners corners;
      const Marker& m = of<Marker>(marker);
      for (std::size_t k = 0; k < 4; ++k)
        corners[k] = *camera.project(
            T.inverse() * (m.T_world_marker * MarkerCornersFactor::corners(m.size_m)[k]));
      graph.add(MarkerCornersFactor(camera, corners, 0.5), {camera_pose, marker});
    }
    for (int i = 0; i < 12; ++i) {
      const bool on_ground = i < 4;
      Point p(random_.uniform(-2, 2), random_.uniform(-1, 1), random_.uniform(5, 9));
      if (on_ground) p -= of<Plane3>(ground).distance_to(p) * of<Plane3>(ground).normal();
      const int point = add(p, 0.05);
      if (on_ground) graph.add(PointOnPlaneFactor(0.02), {point, ground});
      for (const int camera_pose : {a, b, c})
        graph.add(PointObservationFactor<Reprojection>(Reprojection(
                      camera, *camera.project(of<SE3>(camera_pose).inverse() * p), 0.5)),
                  {camera_pose, point}, {RobustKernel::Kind::kHuber, 3});
    }
  }

 private:
  Random random_{17};
};

TEST(FactorGraph, RecoversVariablesOfEveryKindFromExactMeasurements) {
  const Mixed world;
  FactorGraphOptions options;
  options.relative_decrease = 1e-14;
  const FactorGraphReport report = optimize_factor_graph(world.graph, options);
  ASSERT_TRUE(report.outcome) << report.outcome.reason;
  EXPECT_GT(report.cost_initial, 10);
  EXPECT_LT(report.cost_final, 1e-12);
  for (std::size_t i = 0; i < world.truth.size(); ++i) {
    const double error = std::visit(
        [&](const auto& truth) {
          using T = std::decay_t<decltype(truth)>;
          return VariableBlock<T>::minus(report.graph.value<T>(static_cast<int>(i)), truth).norm();
        },
        world.truth[i]);
    EXPECT_LT(error, 1e-6) << "variable " << i << ", a " << kind_name(world.truth[i]);
  }
}

TEST(FactorGraph, MarginalCovarianceIsABlockOfTheDenseInverse) {
  const Mixed world;
  FactorGraph graph = world.graph;
  for (FactorGraph::Term& term : graph.terms) term.kernel = {};
  // J of everything by finite differences of the residuals.
  std::vector<Eigen::Index> columns;
  Eigen::Index n = 0, rows = 0;
  for (const FactorGraph::Node& node : graph.variables) {
    columns.push_back(n);
    n += node.held ? 0 : degrees_of_freedom(node.value);
  }
  for (const FactorGraph::Term& term : graph.terms) rows += term.factor->residual_size();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, n);
  Eigen::Index row = 0;
  for (const FactorGraph::Term& term : graph.terms) {
    std::vector<Variable> values;
    for (const int i : term.variables)
      values.push_back(graph.variables[static_cast<std::size_t>(i)].value);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto i = static_cast<std::size_t>(term.variables[k]);
      if (graph.variables[i].held) continue;
      for (Eigen::Index j = 0; j < degrees_of_freedom(values[k]); ++j) {
        std::vector<Variable> up = values, down = values;
        const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(degrees_of_freedom(values[k]), j);
        up[k] = plus(values[k], step);
        down[k] = plus(values[k], -step);
        J.block(row, columns[i] + j, term.factor->residual_size(), 1) =
            (test::evaluate(*term.factor, up) - test::evaluate(*term.factor, down)) / 2e-5;
      }
    }
    row += term.factor->residual_size();
  }
  const Eigen::MatrixXd dense = (J.transpose() * J).inverse();
  const std::vector<int> asked{2, 6, 1};  // a pose, a line, a pose
  std::vector<Eigen::Index> picked;
  for (const int i : asked)
    for (int j = 0; j < degrees_of_freedom(graph.variables[static_cast<std::size_t>(i)].value); ++j)
      picked.push_back(columns[static_cast<std::size_t>(i)] + j);
  const Eigen::MatrixXd expected = dense(picked, picked);
  const MarginalCovariance marginal = marginal_covariance(graph, asked);
  ASSERT_TRUE(marginal.outcome) << marginal.outcome.reason;
  EXPECT_LT((marginal.covariance - expected).norm(), 1e-5 * expected.norm());
}

/// A chain of poses with chords, two of them wrong, as a pose graph.
template <class Group>
PoseGraph chain(std::uint64_t seed) {
  Random random(seed);
  const auto element = [&](double sigma) {
    typename Group::Tangent xi;
    for (int i = 0; i < Group::kDof; ++i) xi[i] = sigma * random.normal();
    return Group::exp(xi);
  };
  PoseGraph graph;
  std::vector<Group> truth;
  for (int i = 0; i < 12; ++i) {
    truth.push_back(i == 0 ? Group() : truth.back() * element(0.5));
    graph.nodes.push_back({NodeId(100 + i), Group(truth.back() * element(0.05)), i == 3});
  }
  for (int i = 0; i < 12; ++i)
    for (const int j : {i + 1, i + 4}) {
      if (j >= 12) continue;
      RelativePoseConstraint c;
      c.from = NodeId(100 + i);
      c.to = NodeId(100 + j);
      c.T_from_to = Group(truth[static_cast<std::size_t>(i)].inverse() *
                          truth[static_cast<std::size_t>(j)] * element(i == 5 ? 0.5 : 0.02));
      c.information = Information(Information::Identity(Group::kDof, Group::kDof) * 400);
      if (j == i + 4) c.kernel = {RobustKernel::Kind::kHuber, 1};
      graph.constraints.emplace_back(c);
    }
  PositionConstraint position;
  position.node = NodeId(111);
  position.position_world = Eigen::Vector3d(0.5, 1, 0);
  position.lever_arm = Eigen::Vector3d(0.1, 0, 0);
  graph.constraints.emplace_back(position);
  return graph;
}

template <class Group>
class FactorGraphOfPoses : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(FactorGraphOfPoses, Groups);

TYPED_TEST(FactorGraphOfPoses, HasTheMinimumOfThePoseGraph) {
  using Group = TypeParam;
  const PoseGraph poses = chain<Group>(5);
  for (const RotationError kind : {RotationError::kLog, RotationError::kQuaternion}) {
    PoseGraphOptions pose_options;
    pose_options.rotation_error = kind;
    pose_options.relative_decrease = 1e-15;
    const PoseGraphReport expected = optimize_pose_graph(poses, pose_options);
    FactorGraphOptions options;
    options.relative_decrease = 1e-15;
    const FactorGraphReport report = optimize_factor_graph(to_factor_graph(poses, kind), options);
    ASSERT_TRUE(report.outcome) << report.outcome.reason;
    const auto squares = squared_residuals(report.graph);
    for (std::size_t i = 0; i < squares.size(); ++i)
      EXPECT_NEAR(*squares[i], expected.chi2_by_constraint[i], 1e-5 * expected.chi2_final);
    for (std::size_t i = 0; i < poses.nodes.size(); ++i) {
      const Group& a = std::get<Group>(expected.graph.nodes[i].T_world_node);
      EXPECT_LT((a.inverse() * report.graph.value<Group>(static_cast<int>(i))).log().norm(), 1e-5);
    }
  }
}

TEST(FactorGraph, TellsWhenThereIsNothingToEstimate) {
  FactorGraph graph;
  EXPECT_EQ(optimize_factor_graph(graph, {}).outcome.code, Outcome::Code::kTooFewData);
  graph.add(Measured<double>(1, 1), {graph.add_variable(3.0, true)});
  graph.add_variable(4.0);
  EXPECT_EQ(optimize_factor_graph(graph, {}).outcome.code, Outcome::Code::kTooFewData);
}

TEST(FactorGraph, TellsWhenItDoesNotConverge) {
  FactorGraph graph;
  const int x = graph.add_variable(3.0);
  graph.add(Never(), {x});
  const FactorGraphReport report = optimize_factor_graph(graph, {});
  EXPECT_EQ(report.outcome.code, Outcome::Code::kNotConverged);
  EXPECT_EQ(report.graph.value<double>(x), 3);
  EXPECT_FALSE(squared_residuals(graph)[0]);

  FactorGraphOptions once;
  once.max_iterations = 1;
  once.relative_decrease = 0;
  EXPECT_EQ(optimize_factor_graph(Mixed().graph, once).outcome.code, Outcome::Code::kNotConverged);
}

TEST(FactorGraph, HasNoCovarianceWhereADirectionIsOpen) {
  FactorGraph graph;
  const int a = graph.add_variable(SE3()), b = graph.add_variable(SE3());
  graph.add(RelativePoseFactor<SE3>(SE3(), Matrix6d::Identity()), {a, b});
  EXPECT_EQ(marginal_covariance(graph, {a}).outcome.code, Outcome::Code::kDegenerate);
  const int alone = graph.add_variable(1.0);
  EXPECT_EQ(marginal_covariance(graph, {alone}).outcome.code, Outcome::Code::kDegenerate);
  graph.variables[0].held = true;
  EXPECT_TRUE(marginal_covariance(graph, {b}).outcome);
  EXPECT_THROW((void)marginal_covariance(graph, {a}), ArgumentError);
  EXPECT_THROW((void)marginal_covariance(graph, {b, b}), ArgumentError);
  EXPECT_THROW((void)marginal_covariance(graph, {9}), ArgumentError);
}

std::string refusal(const FactorGraph& graph) {
  try {
    graph.check();
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return "";
}

TEST(FactorGraph, RefusesTermsThatDoNotFitTheirVariables) {
  using testing::HasSubstr;
  FactorGraph good;
  const int pose = good.add_variable(SE3()), point = good.add_variable(Point(0, 0, 1));
  FactorGraph graph = good;
  graph.add(DistanceFactor(1, 1), {pose, point});
  EXPECT_THAT(refusal(graph), HasSubstr("term 0 takes (SE3, SE3), given (SE3, point)"));
  graph = good;
  graph.add(DistanceFactor(1, 1), {pose});
  EXPECT_THAT(refusal(graph), HasSubstr("takes (SE3, SE3), given (SE3)"));
  graph = good;
  graph.add(DistanceFactor(1, 1), {pose, pose});
  EXPECT_THAT(refusal(graph), HasSubstr("has a variable twice"));
  graph = good;
  graph.add(DistanceFactor(1, 1), {pose, 7});
  EXPECT_THAT(refusal(graph), HasSubstr("there is no variable 7"));
  graph = good;
  graph.terms.push_back({nullptr, {pose}, {}});
  EXPECT_THAT(refusal(graph), HasSubstr("term 0 has no factor"));
  graph = good;
  graph.add(Measured<Point>({0, 0, 0}, 1), {point}, {RobustKernel::Kind::kHuber, 0});
  EXPECT_THAT(refusal(graph), HasSubstr("kernel's width"));
  graph = good;
  graph.variables[1].value = Point(0, std::nan(""), 0);
  EXPECT_THAT(refusal(graph), HasSubstr("variable 1 is not finite"));
  EXPECT_EQ(refusal(good), "");
  EXPECT_THROW((void)good.value<Point>(pose), ArgumentError);
  EXPECT_THROW((void)good.value<Point>(5), ArgumentError);
  FactorGraphOptions bad;
  bad.max_iterations = 0;
  EXPECT_THROW((void)optimize_factor_graph(good, bad), ArgumentError);
}

}  // namespace factor_graph_test
}  // namespace placegraph
