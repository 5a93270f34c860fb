#include <gtest/gtest.h>
#include <placegraph/eval/edges/edge_consistency.h>
#include <placegraph/eval/edges/edge_mount.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

namespace placegraph {
namespace edge_consistency_test {

const SE3 kStep(SO3::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(1, 2, 3));

std::map<NodeId, SE3> chain(int nodes) {
  std::map<NodeId, SE3> truth;
  SE3 T(SO3::exp({1, 0.5, -0.2}), Eigen::Vector3d(7, 0, -4));
  for (int i = 0; i < nodes; ++i, T = T * kStep) truth[NodeId(i)] = T;
  return truth;
}

RelativePoseConstraint edge(std::int64_t from, const Vector6d& error, double sigma) {
  RelativePoseConstraint constraint;
  constraint.from = NodeId(from);
  constraint.to = NodeId(from + 1);
  constraint.T_from_to = kStep * SE3::exp(error).inverse();
  constraint.information = Information::Identity(6, 6) / (sigma * sigma);
  return constraint;
}

/// The judgement of odometry edges.
EdgeConsistency judged(const std::vector<RelativePoseConstraint>& edges, const TrueNodes& truth) {
  return edge_consistency(edges, truth).at(ConstraintSource::kOdometry);
}

TrueNodes exact(std::map<NodeId, SE3> T_world_node) {
  TrueNodes truth;
  truth.T_world_node = std::move(T_world_node);
  return truth;
}

Vector6d normal_vector(Random& random, double sigma) {
  Vector6d error;
  for (int k = 0; k < 6; ++k) error[k] = random.normal(0, sigma);
  return error;
}

/// Edges whose errors are `factor` times as large as they claim.
std::vector<RelativePoseConstraint> noisy_edges(int count, double factor) {
  Random random(4);
  std::vector<RelativePoseConstraint> edges;
  for (int i = 0; i < count; ++i)
    edges.push_back(edge(i, normal_vector(random, factor * 0.01), 0.01));
  return edges;
}

TEST(EdgeConsistency, OfKnownErrorsIsTheirSquareOverTheDegreesOfFreedom) {
  Vector6d error = Vector6d::Zero();
  error[1] = 0.3;
  const auto result = judged(
      {edge(0, Vector6d::Zero(), 0.1), edge(1, error, 0.1), edge(2, error, 0.05)}, exact(chain(4)));
  EXPECT_EQ(result.edges, 3);
  EXPECT_EQ(result.unknown, 0);
  EXPECT_EQ(result.degrees_of_freedom, 18);
  EXPECT_NEAR(result.by_stated.mean, (0 + 9.0 / 6 + 36.0 / 6) / 3, 1e-9);
  EXPECT_NEAR(result.by_stated.median, 9.0 / 6, 1e-9);
  EXPECT_NEAR(result.by_stated.share_beyond_99, 1.0 / 3, 1e-12);  // chi^2 of 36 beyond 16.8
  EXPECT_EQ(result.with_truth.mean, result.by_stated.mean);
  EXPECT_EQ(result.truth_share, 0);
  ASSERT_EQ(result.axes.size(), 6u);
  EXPECT_EQ(result.axes[1].name, "translation along y");
  EXPECT_NEAR(result.axes[1].error, std::sqrt(2 * 0.09 / 3), 1e-9);
  EXPECT_NEAR(result.axes[1].stated, std::sqrt((2 * 0.01 + 0.0025) / 3), 1e-9);
  EXPECT_NEAR(result.axes[1].normalized, std::sqrt((9.0 + 36) / 3), 1e-9);
}

TEST(EdgeConsistency, IsOneWhereClaimsAreRight) {
  const auto result = judged(noisy_edges(2000, 1), exact(chain(2001)));
  EXPECT_NEAR(result.by_stated.mean, 1, 0.05);
  EXPECT_NEAR(result.by_stated.median, 5.348 / 6, 0.05);  // median of chi^2 over six
  EXPECT_NEAR(result.by_stated.share_beyond_99, 0.01, 0.007);
}

TEST(EdgeConsistency, LeavesOutEdgesOfUnknownTruthAndRefusesEdgesInThePlane) {
  auto truth = exact(chain(3));
  truth.T_world_node.erase(NodeId(2));
  const auto result = judged({edge(0, Vector6d::Zero(), 1), edge(1, Vector6d::Zero(), 1)}, truth);
  EXPECT_EQ(result.edges, 1);
  EXPECT_EQ(result.unknown, 1);
  EXPECT_TRUE(edge_consistency({}, truth).empty());
  RelativePoseConstraint planar = edge(0, Vector6d::Zero(), 1);
  planar.T_from_to = SE2();
  planar.information = Information::Identity(3, 3);
  EXPECT_THROW((void)edge_consistency({planar}, truth), ArgumentError);
  EXPECT_THROW((void)edge_consistency({edge(0, Vector6d::Zero(), 1), planar}, truth),
               ArgumentError);
}

TEST(EdgeConsistency, DistinguishesNoiseOfTheTruthFromErrorsOfEdges) {
  constexpr int kEdges = 1000;
  Random random(11);
  TrueNodes truth = exact(chain(kEdges + 1));
  truth.noise = TruthNoise::white(0.02, 0.004);
  for (auto& [node, pose] : truth.T_world_node)
    pose = pose.plus(truth.noise.sigma.cwiseProduct(normal_vector(random, 1)));
  const auto result = judged(noisy_edges(kEdges, 1), truth);
  EXPECT_GT(result.by_stated.mean, 2);
  EXPECT_NEAR(result.with_truth.mean, 1, 0.1);
  EXPECT_NEAR(result.truth_share, 1 - 1 / result.by_stated.mean, 0.1);
}

TEST(EdgeConsistency, LeavesOutInterpolatedPoses) {
  TrueNodes truth = exact(chain(5));
  truth.noise.interpolated = {{10, 20}};
  for (int i = 0; i < 5; ++i) truth.frames[NodeId(i)] = 7 * i;  // 14 is inside
  const auto result = judged(noisy_edges(4, 1), truth);
  EXPECT_EQ(result.edges, 2);
  EXPECT_EQ(result.interpolated, 2);
}

TEST(EdgeConsistency, EndsWithAVerdict) {
  const auto verdict = [](int edges, double factor) {
    return verdict_on(judged(noisy_edges(edges, factor), exact(chain(edges + 1))));
  };
  EXPECT_EQ(verdict(200, 1), EdgeVerdict::kHold);
  EXPECT_EQ(verdict(200, 3), EdgeVerdict::kTooSmall);
  EXPECT_EQ(verdict(200, 0.5), EdgeVerdict::kTooLarge);
  EXPECT_EQ(verdict(2, 1), EdgeVerdict::kTooFewEdges);
  EXPECT_EQ(verdict(2, 10), EdgeVerdict::kTooSmall);
  EXPECT_EQ(verdict_on({}), EdgeVerdict::kNoEdges);
  EdgeConsistency doubtful = judged(noisy_edges(200, 3), exact(chain(201)));
  doubtful.truth_share = 0.84;
  EXPECT_EQ(verdict_on(doubtful), EdgeVerdict::kNotTestable);
  // Noise of the truth makes no error smaller.
  EdgeConsistency cautious = judged(noisy_edges(200, 0.5), exact(chain(201)));
  cautious.truth_share = 1;
  EXPECT_EQ(verdict_on(cautious), EdgeVerdict::kTooLarge);
  cautious.truth_share = 0.4, cautious.by_stated.mean = 0.7, cautious.with_truth.mean = 0.4;
  EXPECT_EQ(verdict_on(cautious), EdgeVerdict::kHold);
  EXPECT_EQ(sentence_of(ConstraintSource::kOdometry, doubtful),
            "The covariances of the odometry are not testable: the truth's own noise makes 84 % of "
            "the errors.");
}

TEST(EdgeConsistency, NamesTheWorstAxis) {
  std::vector<RelativePoseConstraint> edges = noisy_edges(100, 1);
  const Vector6d rotation = 0.05 * Vector6d::Unit(4);
  for (RelativePoseConstraint& edge : edges)
    edge.T_from_to = std::get<SE3>(edge.T_from_to).plus(rotation);
  const std::string sentence =
      sentence_of(ConstraintSource::kOdometry, judged(edges, exact(chain(101))));
  EXPECT_NE(sentence.find("too small"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("largest: rotation about y, "), std::string::npos) << sentence;
}

TEST(EdgeConsistency, NamesNoAxisThatIsWithinItsDeviation) {
  EdgeConsistency combined = judged(noisy_edges(100, 3), exact(chain(101)));
  for (AxisConsistency& axis : combined.axes) axis.normalized = 0.5;
  const std::string sentence = sentence_of(ConstraintSource::kOdometry, combined);
  EXPECT_NE(sentence.find("combinations of axes are not"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find("largest"), std::string::npos) << sentence;
}

TEST(EdgeConsistency, GivesTheIntervalOfTheMean) {
  const auto [low, high] = nees_interval({1, 1, 0}, 60);
  EXPECT_NEAR(low, 60 / 83.30, 0.002);  // quantiles of chi^2 over 60 in tables
  EXPECT_NEAR(high, 60 / 40.48, 0.002);
}

/// A graph whose nodes have units of length of their own.
struct UnitGraph {
  std::vector<RelativePoseConstraint> edges;
  std::vector<double> units;
  TrueNodes truth;

  explicit UnitGraph(int count) : truth(exact(chain(count + 1))) {
    Random random(6);
    for (int i = 0; i <= count; ++i) units.push_back(std::exp(random.uniform(-1, 1)));
  }
  /// An edge with errors of one hundredth, which it claims, or that times `factor`.
  void add(int from, int to, ConstraintSource source, Random& random, double factor = 1) {
    constexpr double kSigma = 0.01;
    const double unit = units[static_cast<std::size_t>(from)],
                 end = units[static_cast<std::size_t>(to)];
    const SE3 T = truth.T_world_node.at(NodeId(from)).inverse() * truth.T_world_node.at(NodeId(to));
    const double length = T.translation().norm() / end;
    Vector7d sigma = Vector7d::Constant(kSigma);
    sigma.head<3>() *= length;
    Vector7d error;
    for (int k = 0; k < 7; ++k) error[k] = random.normal(0, factor * sigma[k]);
    RelativePoseConstraint edge;
    edge.from = NodeId(from), edge.to = NodeId(to), edge.source = source;
    edge.T_from_to =
        Sim3(T.rotation(), T.translation() / unit, end / unit) * Sim3::exp(error).inverse();
    edge.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    edges.push_back(edge);
  }
};

TEST(EdgeConsistency, OfSimilaritiesTestsDirectionRotationAndChangeOfScale) {
  constexpr int kNodes = 500;
  UnitGraph graph(kNodes);
  Random random(8);
  for (int i = 0; i < kNodes; ++i) graph.add(i, i + 1, ConstraintSource::kOdometry, random);
  for (int i = 0; i + 2 < kNodes; i += 2) graph.add(i + 2, i, ConstraintSource::kLoop, random);
  const auto result = edge_consistency(graph.edges, graph.truth);
  const EdgeConsistency& odometry = result.at(ConstraintSource::kOdometry);
  EXPECT_EQ(odometry.edges, kNodes);
  EXPECT_EQ(odometry.degrees_of_freedom, 6 * kNodes - 1);  // nothing begins at the last node
  EXPECT_NEAR(odometry.by_stated.mean, 1, 0.1);
  const EdgeConsistency& loops = result.at(ConstraintSource::kLoop);
  EXPECT_EQ(loops.degrees_of_freedom, 7 * loops.edges);
  EXPECT_NEAR(loops.by_stated.mean, 1, 0.1);
}

TEST(EdgeConsistency, OfSimilaritiesFindsAScaleThatDriftsMoreThanItClaims) {
  UnitGraph graph(100);
  Random random(8);
  for (int i = 0; i < 100; ++i) graph.add(i, i + 1, ConstraintSource::kOdometry, random);
  for (RelativePoseConstraint& edge : graph.edges)
    edge.T_from_to = std::get<Sim3>(edge.T_from_to).plus(random.normal(0, 0.1) * Vector7d::Unit(6));
  const EdgeConsistency result = judged(graph.edges, graph.truth);
  EXPECT_EQ(verdict_on(result), EdgeVerdict::kTooSmall);
  EXPECT_EQ(result.axes.back().name, "change of scale");
  EXPECT_NEAR(result.axes.back().normalized, std::sqrt(0.01 + 0.0003) / std::sqrt(0.0003), 1);
  EXPECT_LT(result.axes.front().normalized, 1.2);
}

TEST(EdgeConsistency, OfSimilaritiesLeavesOutEdgesWithoutDirection) {
  UnitGraph graph(6);
  graph.truth.T_world_node[NodeId(3)] =
      graph.truth.T_world_node.at(NodeId(2)).plus(1e-6 * Vector6d::Ones());
  Random random(8);
  for (int i = 0; i < 6; ++i) graph.add(i, i + 1, ConstraintSource::kOdometry, random);
  const EdgeConsistency result = judged(graph.edges, graph.truth);
  EXPECT_EQ(result.edges, 5);
  EXPECT_EQ(result.unknown, 1);
  EXPECT_EQ(result.degrees_of_freedom, 5 * 6 - 2);  // no unit at node 2, none at the last one
}

/// Edges with errors of 0.001 that they claim, between poses that turn about all axes, and the
/// truth of a frame in which the camera is at `T_truth_cam`.
struct MountedCamera {
  std::vector<RelativePoseConstraint> edges;
  TrueNodes truth;

  explicit MountedCamera(const SE3& T_truth_cam) {
    Random random(12);
    SE3 T_world_cam;
    for (int i = 0; i <= 60; ++i) {
      truth.T_world_node[NodeId(i)] = T_world_cam * T_truth_cam.inverse();
      const SE3 T = SE3::exp(normal_vector(random, 0.5));
      RelativePoseConstraint next = edge(i, Vector6d::Zero(), 0.001);
      next.T_from_to = T.plus(normal_vector(random, 0.001));
      if (i < 60) edges.push_back(next);
      T_world_cam = T_world_cam * T;
    }
  }
};

TEST(TruthMount, IsFoundAndRemoved) {
  const SE3 T_truth_cam(SO3::exp({0.004, -0.006, 0.003}), Eigen::Vector3d(0.02, -0.01, 0.03));
  const MountedCamera camera(T_truth_cam);
  const TruthMount mount = fit_mount(camera.edges, camera.truth);
  const Vector6d off = (mount.T_truth_cam.inverse() * T_truth_cam).log();
  for (int k = 0; k < 6; ++k) EXPECT_LT(std::abs(off[k]), 3 * mount.sigma[k]) << k;
  EXPECT_LT(mount.sigma.maxCoeff(), 0.001);
  EXPECT_NEAR(mount.parameters, 6, 0.01);
  EXPECT_GT(judged(camera.edges, camera.truth).by_stated.mean, 5);
  const EdgeConsistency result = judged(camera.edges, mounted(camera.truth, mount));
  EXPECT_NEAR(result.by_stated.mean, 1, 0.25);
  EXPECT_EQ(result.degrees_of_freedom, 6 * 60 - 6);
}

TEST(TruthMount, StaysAtThePriorOnAStraightLine) {
  const MountedCamera camera((SE3()));
  EXPECT_LT(fit_mount({}, camera.truth).T_truth_cam.log().norm(), 1e-12);
  EXPECT_EQ(fit_mount({}, camera.truth).parameters, 0);
  TrueNodes straight;
  std::vector<RelativePoseConstraint> edges;
  for (int i = 0; i <= 20; ++i) {
    const SE3 ahead(SO3(), Eigen::Vector3d(0, 0, 1));
    straight.T_world_node[NodeId(i)] = SE3(SO3(), Eigen::Vector3d(0, 0, i));
    RelativePoseConstraint next = edge(i, Vector6d::Zero(), 0.001);
    next.T_from_to = ahead;
    if (i < 20) edges.push_back(next);
  }
  const TruthMount mount = fit_mount(edges, straight);
  EXPECT_NEAR(mount.parameters, 2, 0.01);  // the angles to the direction of motion
  EXPECT_LT(mount.T_truth_cam.log().norm(), 1e-9);
}

}  // namespace edge_consistency_test
}  // namespace placegraph
