#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <cmath>
#include <set>

#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace robust_loops_test {

using test::LoopedWalk;
using test::LoopedWalkOptions;

PoseGraphReport optimize(const PoseGraph& graph, RobustMethod method) {
  PoseGraphOptions options;
  options.initialization =
      PoseGraphInitialization::kFile;  // the same for all methods: bits are compared
  options.robust.method = method;
  return optimize_pose_graph(graph, options);
}

/// Root mean square of the distances between estimates that hold the same first node [m].
template <class Group>
double rms_distance(const PoseGraph& a, const PoseGraph& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    sum += (std::get<Group>(a.nodes[i].T_world_node).translation() -
            std::get<Group>(b.nodes[i].T_world_node).translation())
               .squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.nodes.size()));
}

std::set<std::pair<NodeId, NodeId>> ends_of_rejected(const PoseGraphReport& report) {
  std::set<std::pair<NodeId, NodeId>> ends;
  for (const RejectedEdge& edge : report.rejected) {
    const auto& c = std::get<RelativePoseConstraint>(report.graph.constraints[edge.constraint]);
    ends.insert({c.from, c.to});
  }
  return ends;
}

template <class Group>
class RobustLoopsOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(RobustLoopsOf, Groups);

TYPED_TEST(RobustLoopsOf, AutoFindsExactlyTheFalseOnesLoneOrInAgreeingGroups) {
  for (const int cluster : {1, 4})
    for (const int false_loops : {4, 100}) {
      const LoopedWalk<TypeParam> walk({.false_loops = false_loops, .cluster = cluster, .seed = 3});
      PoseGraph clean = walk.graph;
      clean.constraints.resize(walk.true_constraints);
      const PoseGraph best = optimize(clean, RobustMethod::kNone).graph;
      for (const RobustMethod method : {RobustMethod::kAuto, RobustMethod::kPcm}) {
        const PoseGraphReport report = optimize(walk.graph, method);
        EXPECT_TRUE(report.outcome) << report.outcome.reason;
        EXPECT_EQ(report.rejected.size(), static_cast<std::size_t>(false_loops))
            << "groups of " << cluster;
        for (const RejectedEdge& edge : report.rejected)
          EXPECT_GE(edge.constraint, static_cast<int>(walk.true_constraints));
        EXPECT_LT(rms_distance<TypeParam>(report.graph, best), 1e-4);
      }
    }
}

TYPED_TEST(RobustLoopsOf, PosesThatSayNothingDoNoHarm) {
  const LoopedWalk<TypeParam> walk({.false_loops = 30, .seed = 4});
  PoseGraph blind = walk.graph;
  for (PoseNode& node : blind.nodes) node.T_world_node = blind.nodes.front().T_world_node;
  for (const RobustMethod method : {RobustMethod::kAuto, RobustMethod::kPcm, RobustMethod::kGnc}) {
    PoseGraphOptions options;
    options.robust.method = method;
    const PoseGraphReport seeing = optimize_pose_graph(walk.graph, options);
    const PoseGraphReport report = optimize_pose_graph(blind, options);
    EXPECT_EQ(ends_of_rejected(report), ends_of_rejected(seeing));
    EXPECT_LT(rms_distance<TypeParam>(report.graph, seeing.graph), 1e-4);
  }
}

TYPED_TEST(RobustLoopsOf, AutoGivesThePlainOptimumWhereNothingIsFalse) {
  for (const double claimed : {0.005, 0.02, 0.2})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const LoopedWalk<TypeParam> walk({.claimed = claimed, .seed = seed});
      const PoseGraphReport plain = optimize(walk.graph, RobustMethod::kNone);
      const PoseGraphReport report = optimize(walk.graph, RobustMethod::kAuto);
      EXPECT_TRUE(report.rejected.empty()) << report.rejected.size() << " seed " << seed;
      EXPECT_EQ(rms_distance<TypeParam>(report.graph, plain.graph), 0);
    }
}

TYPED_TEST(RobustLoopsOf, NothingDependsOnTheOrderOfTheConstraints) {
  const LoopedWalk<TypeParam> walk({.false_loops = 100, .cluster = 2, .seed = 5});
  const PoseGraphReport report = optimize(walk.graph, RobustMethod::kAuto);
  PoseGraph shuffled = walk.graph;
  Random random(11);
  for (std::size_t i = shuffled.constraints.size(); i > 1; --i)
    std::swap(shuffled.constraints[i - 1], shuffled.constraints[random.index(static_cast<int>(i))]);
  const PoseGraphReport again = optimize(shuffled, RobustMethod::kAuto);
  EXPECT_EQ(ends_of_rejected(again), ends_of_rejected(report));
  EXPECT_LT(rms_distance<TypeParam>(again.graph, report.graph), 1e-6);
}

TYPED_TEST(RobustLoopsOf, WhatAloneHoldsThePartsTogetherIsKept) {
  LoopedWalk<TypeParam> walk({.nodes = 120, .false_loops = 20, .seed = 2});
  for (Constraint& constraint : walk.graph.constraints) {  // the odometry breaks at 60
    auto& relative = std::get<RelativePoseConstraint>(constraint);
    if (relative.from == NodeId(59) && relative.to == NodeId(60))
      relative.source = ConstraintSource::kOther;
  }
  const PoseGraphReport report = optimize(walk.graph, RobustMethod::kAuto);
  EXPECT_TRUE(report.outcome) << report.outcome.reason;
  for (const PoseNode& node : report.graph.nodes)
    EXPECT_TRUE(std::get<TypeParam>(node.T_world_node).translation().allFinite());
  PoseGraph kept = report.graph;
  std::set<int> rejected;
  for (const RejectedEdge& edge : report.rejected) rejected.insert(edge.constraint);
  kept.constraints.clear();
  for (std::size_t i = 0; i < walk.graph.constraints.size(); ++i)
    if (!rejected.contains(static_cast<int>(i)))
      kept.constraints.push_back(walk.graph.constraints[i]);
  for (const int component : kept.components()) EXPECT_EQ(component, 0);
}

/// The loop as another program may write it again: with rounded numbers, or from its other end.
template <class Group>
RelativePoseConstraint written_again(const RelativePoseConstraint& loop, double rounding,
                                     bool from_other_end) {
  RelativePoseConstraint copy = loop;
  auto xi = std::get<Group>(loop.T_from_to).log();
  if (rounding > 0)
    for (double& value : xi) value = rounding * std::round(value / rounding);
  copy.T_from_to = Group::exp(xi);
  if (!from_other_end) return copy;
  std::swap(copy.from, copy.to);
  const auto adjoint = std::get<Group>(copy.T_from_to).adjoint();  // of the information, too
  copy.information = adjoint.inverse().transpose() * loop.information * adjoint.inverse();
  copy.T_from_to = std::get<Group>(copy.T_from_to).inverse();
  return copy;
}

// A loop that is written twice is no second witness, and its ring with itself is no measurement of
// the noise.
TYPED_TEST(RobustLoopsOf, LoopsThatAreWrittenAgainChangeNoDecision) {
  constexpr double kRoundings[] = {0, 1e-6, 1e-3};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    const LoopedWalk<TypeParam> walk({.nodes = 200,
                                      .lap = 40,
                                      .loop_every = 4,
                                      .claimed = 0.02,
                                      .false_loops = static_cast<int>(seed % 4),
                                      .seed = seed});
    PoseGraph again = walk.graph;
    const double share = seed % 2 == 0 ? 1 : random.uniform(0.2, 1);
    const int times = 1 + random.index(4);
    for (const Constraint& constraint : walk.graph.constraints) {
      const auto& loop = std::get<RelativePoseConstraint>(constraint);
      if (loop.source == ConstraintSource::kOdometry || random.uniform() > share) continue;
      for (int i = 0; i < times; ++i)
        again.constraints.push_back(
            written_again<TypeParam>(loop, kRoundings[random.index(3)], random.index(2) == 1));
    }
    for (const RobustMethod method :
         {RobustMethod::kAuto, RobustMethod::kGnc, RobustMethod::kPcm}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " method " << static_cast<int>(method));
      const PoseGraphReport once = optimize(walk.graph, method), report = optimize(again, method);
      const auto ends = [](const PoseGraphReport& r) {
        std::set<std::pair<NodeId, NodeId>> sorted;
        for (const auto& [from, to] : ends_of_rejected(r)) sorted.insert(std::minmax(from, to));
        return sorted;
      };
      EXPECT_EQ(ends(report), ends(once));
    }
  }
}

/// Second edges over `n` steps of the walk that say what loops say elsewhere, or the step itself.
template <class Group>
void repeat_steps(LoopedWalk<Group>& walk, int n, bool falsely, Random& random) {
  const auto nodes = static_cast<int>(walk.graph.nodes.size());
  for (int k = 0; k < n; ++k) {
    const int i = random.index(nodes - 1);
    auto repeated = std::get<RelativePoseConstraint>(walk.graph.constraints[i]);
    if (falsely) {  // beyond what the noise of a loop may be taken for
      typename Group::Tangent xi;
      for (int d = 0; d < Group::kDof; ++d) xi[d] = random.uniform(1, 2);
      repeated.T_from_to = std::get<Group>(repeated.T_from_to) * Group::exp(xi);
    }
    walk.graph.constraints.push_back(repeated);
  }
}

TYPED_TEST(RobustLoopsOf, FalseSecondOdometryIsRejectedWhereverItStandsInTheFile) {
  for (const int steps : {1, 3, 10})
    for (const int false_loops : {0, 100})
      for (const bool first : {false, true}) {
        LoopedWalk<TypeParam> walk({.false_loops = false_loops, .seed = 6});
        PoseGraph clean = walk.graph;
        clean.constraints.resize(walk.true_constraints);
        const PoseGraph best = optimize(clean, RobustMethod::kNone).graph;
        Random random(7);
        repeat_steps(walk, steps, true, random);
        const std::size_t n = walk.graph.constraints.size();
        if (first) std::reverse(walk.graph.constraints.begin(), walk.graph.constraints.end());
        const PoseGraphReport report = optimize(walk.graph, RobustMethod::kAuto);
        EXPECT_TRUE(report.outcome) << report.outcome.reason;
        EXPECT_EQ(report.rejected.size(), static_cast<std::size_t>(false_loops + steps));
        for (const RejectedEdge& edge : report.rejected) {
          const auto i = static_cast<std::size_t>(edge.constraint);
          EXPECT_GE(first ? n - 1 - i : i, walk.true_constraints);
        }
        EXPECT_LT(rms_distance<TypeParam>(report.graph, best), 1e-4) << steps;
      }
}

TYPED_TEST(RobustLoopsOf, RepeatedTrueOdometryIsKept) {
  LoopedWalk<TypeParam> walk({.false_loops = 100, .seed = 8});
  const std::size_t false_end = walk.graph.constraints.size();
  Random random(9);
  repeat_steps(walk, 100, false, random);
  const PoseGraphReport report = optimize(walk.graph, RobustMethod::kAuto);
  EXPECT_EQ(report.rejected.size(), 100u);
  for (const RejectedEdge& edge : report.rejected) {
    EXPECT_GE(edge.constraint, static_cast<int>(walk.true_constraints));
    EXPECT_LT(edge.constraint, static_cast<int>(false_end));
  }
}

TYPED_TEST(RobustLoopsOf, ACommonFactorOfAllInformationChangesNothing) {
  const LoopedWalk<TypeParam> walk({.false_loops = 100, .seed = 10});
  const PoseGraphReport report = optimize(walk.graph, RobustMethod::kAuto);
  EXPECT_EQ(report.rejected.size(), 100u);
  for (const double factor : {1e-12, 1e-9, 1e-3, 1e3, 1e9, 1e12}) {
    PoseGraph scaled = walk.graph;
    for (Constraint& constraint : scaled.constraints)
      std::get<RelativePoseConstraint>(constraint).information *= factor;
    const PoseGraphReport again = optimize(scaled, RobustMethod::kAuto);
    EXPECT_EQ(ends_of_rejected(again), ends_of_rejected(report)) << factor;
    EXPECT_LT(rms_distance<TypeParam>(again.graph, report.graph), 1e-4) << factor;
  }
}

}  // namespace robust_loops_test
}  // namespace placegraph
