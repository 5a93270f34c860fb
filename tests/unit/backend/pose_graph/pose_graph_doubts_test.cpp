#include <fmt/format.h>
#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_doubts.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <string>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace pose_graph_doubts_test {

double printed(double x, int digits, bool fixed) {
  return std::stod(fixed ? fmt::format("{:.{}f}", x, digits) : fmt::format("{:.{}g}", x, digits));
}

SE2 printed(const SE2& T, int digits, bool fixed) {
  const auto p = [&](double x) { return printed(x, digits, fixed); };
  return SE2(p(T.translation().x()), p(T.translation().y()), p(T.rotation().angle()));
}

SE3 printed(const SE3& T, int digits, bool fixed) {
  const auto p = [&](double x) { return printed(x, digits, fixed); };
  const Eigen::Quaterniond& q = T.rotation().quaternion();
  return SE3(SO3(Eigen::Quaterniond(p(q.w()), p(q.x()), p(q.y()), p(q.z()))),
             T.translation().unaryExpr(p));
}

/// Edges over one, two and five poses of a walk, with errors of 2 cm and 0.02 rad times `noise`.
template <class Group>
PoseGraph walk(double step_m, double noise, std::uint64_t seed) {
  Random random(seed);
  PoseGraph graph;
  std::vector<Group> truth(1);
  for (int i = 1; i < 40; ++i)
    truth.push_back(truth.back() * test::random_element<Group>(random, step_m, 0.4));
  for (int i = 0; i < 40; ++i)
    graph.nodes.push_back({NodeId(i), truth[static_cast<std::size_t>(i)], false});
  for (const int over : {1, 2, 5})
    for (int i = 0; i + over < 40; ++i) {
      const Group T =
          truth[static_cast<std::size_t>(i)].inverse() * truth[static_cast<std::size_t>(i + over)];
      typename Group::Tangent error;
      for (double& e : error) e = 0.02 * noise * random.normal();
      graph.constraints.emplace_back(
          test::constraint<Group>(i, i + over, T * Group::exp(error), 2500));
    }
  return graph;
}

template <class Group>
class PoseGraphDoubts : public testing::Test {};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(PoseGraphDoubts, Groups);

TYPED_TEST(PoseGraphDoubts, AreNoneWhereOnlyTheLastDigitIsWrong) {
  for (const double step_m : {0.1, 1.0, 700.0})
    for (const bool fixed : {false, true})
      for (const int digits : {3, 4, 6, 9}) {
        PoseGraph graph = walk<TypeParam>(step_m, 0, 1);
        for (Constraint& constraint : graph.constraints) {
          auto& T = std::get<RelativePoseConstraint>(constraint).T_from_to;
          T = printed(std::get<TypeParam>(T), digits, fixed);
        }
        const PoseGraphReport report = optimize_pose_graph(graph, {});
        for (const Doubt& doubt : report.doubts)
          EXPECT_NE(doubt.kind, DoubtKind::kChi2Below)
              << step_m << " m, " << digits << (fixed ? " decimals: " : " digits: ") << doubt.text;
      }
}

TYPED_TEST(PoseGraphDoubts, AreThoseOfTheScaleOfTheNoise) {
  for (const double noise : {1e-3, 0.1, 1.0, 2.0, 10.0})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const PoseGraphReport report = optimize_pose_graph(walk<TypeParam>(1, noise, seed), {});
      const bool doubted = noise < 0.2 || noise > 5;
      ASSERT_EQ(report.doubts.size(), doubted ? 1u : 0u) << noise;
      if (!doubted) continue;
      EXPECT_EQ(report.doubts[0].kind, noise < 1 ? DoubtKind::kChi2Below : DoubtKind::kChi2Above);
    }
}

TYPED_TEST(PoseGraphDoubts, AreOfOneFalseLoopAmongManyTrueOnes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PoseGraph graph = walk<TypeParam>(1, 1, seed);
    graph.constraints.emplace_back(test::constraint<TypeParam>(3, 30, TypeParam(), 2500));
    const PoseGraphReport report = optimize_pose_graph(graph, {});
    ASSERT_EQ(report.doubts.size(), 1u);
    EXPECT_EQ(report.doubts[0].kind, DoubtKind::kChi2Above);
  }
}

TEST(SomeIds, AreTheFirstTen) {
  std::vector<NodeId> ids;
  for (int i = 0; i < 12; ++i) ids.emplace_back(i);
  EXPECT_EQ(some_ids(ids), "0, 1, 2, 3, 4, 5, 6, 7, 8, 9 and 2 more");
}

}  // namespace pose_graph_doubts_test
}  // namespace placegraph
