#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/backend/georeference/georeference.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace georeference_test {

using testing::ElementsAre;
using testing::HasSubstr;

const GeodeticPosition kOrigin{48.98, 8.39, 116};
const Eigen::Vector3d kArm(-0.3, 0.7, -1.1);
constexpr std::int64_t kStep_ns = 100'000'000;

/// A drive of `count` poses in the ENU frame: an eight with a bump, 1 m a step, camera-like axes.
std::vector<SE3> eight(int count) {
  const SO3 R_body_cam =
      SO3::exp({-std::numbers::pi / 2, 0, 0}) * SO3::exp({0, std::numbers::pi / 2, 0});
  std::vector<SE3> T_enu_cam;
  SE3 T_enu_body(SO3(), {300, -200, 4});
  for (int i = 0; i < count; ++i) {
    T_enu_cam.push_back(T_enu_body * SE3(R_body_cam, {0, 0, 0}));
    Vector6d step;
    step << 1, 0, 0.05 * std::sin(0.2 * i), 0.02 * std::sin(0.3 * i), 0, i % 80 < 40 ? 0.12 : -0.12;
    T_enu_body = T_enu_body.plus(step);
  }
  return T_enu_cam;
}

RelativePoseConstraint edge_between(NodeId from, NodeId to, const Pose& T_from_to, int dof) {
  RelativePoseConstraint edge;
  edge.from = from;
  edge.to = to;
  edge.T_from_to = T_from_to;
  edge.information = 1e4 * Information::Identity(dof, dof);
  return edge;
}

GpsFix fix_at(std::int64_t stamp_ns, const Eigen::Vector3d& position_enu, double accuracy_m = 0.5) {
  GpsFix fix;
  fix.stamp_ns = stamp_ns;
  fix.position = EnuFrame(kOrigin).to_geodetic(position_enu);
  fix.accuracy_m = accuracy_m;
  return fix;
}

/// The drive as a map that begins at the identity, and exact fixes at the times of the nodes.
GeoreferenceInput exact_drive(const std::vector<SE3>& T_enu_cam) {
  GeoreferenceInput in;
  in.origin = kOrigin;
  in.lever_arm = kArm;
  for (std::size_t i = 0; i < T_enu_cam.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    in.graph.nodes.push_back({NodeId(id), T_enu_cam[0].inverse() * T_enu_cam[i], i == 0});
    in.visits.push_back({id * kStep_ns, NodeId(id)});
    in.fixes.push_back(fix_at(id * kStep_ns, T_enu_cam[i] * kArm));
    if (i > 0)
      in.graph.constraints.emplace_back(
          edge_between(NodeId(id - 1), NodeId(id), T_enu_cam[i - 1].inverse() * T_enu_cam[i], 6));
  }
  return in;
}

double largest_error(const GeoreferenceResult& result, const std::vector<SE3>& T_enu_cam) {
  double largest = 0;
  for (std::size_t i = 0; i < result.graph.nodes.size(); ++i)
    largest = std::max(
        largest,
        (rigid_part(result.graph.nodes[i].T_world_node).translation() -
         T_enu_cam[static_cast<std::size_t>(result.graph.nodes[i].id.value())].translation())
            .norm());
  return largest;
}

TEST(Georeference, PutsAnExactMapWhereItsFixesAre) {
  const auto truth = eight(80);
  const GeoreferenceResult result = georeference(exact_drive(truth), {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(largest_error(result, truth), 1e-4);
  EXPECT_EQ(result.fixes_used, 80);
  EXPECT_EQ(result.fixes_rejected, 0);
  EXPECT_EQ(result.accuracy_factor_horizontal, 1);
  EXPECT_TRUE(result.dropouts.empty());
  EXPECT_LT((result.T_enu_map.translation() - truth[0].translation()).norm(), 1e-4);
  ASSERT_EQ(result.trajectory.size(), 80u);
  EXPECT_LT(
      (result.trajectory.poses[50].T_world_body->translation() - truth[50].translation()).norm(),
      1e-4);
  EXPECT_EQ(result.origin.latitude_deg, kOrigin.latitude_deg);
}

/// The exact drive as a map without scale: its unit is 10 m.
GeoreferenceInput drive_without_scale(const std::vector<SE3>& truth) {
  GeoreferenceInput in = exact_drive(truth);
  for (PoseNode& node : in.graph.nodes) {
    const SE3 T = std::get<SE3>(node.T_world_node);
    node.T_world_node = Sim3(T.rotation(), 0.1 * T.translation(), 1);
  }
  for (Constraint& constraint : in.graph.constraints) {
    auto& edge = std::get<RelativePoseConstraint>(constraint);
    const SE3 T = std::get<SE3>(edge.T_from_to);
    edge = edge_between(edge.from, edge.to, Sim3(T.rotation(), 0.1 * T.translation(), 1), 7);
  }
  return in;
}

TEST(Georeference, GivesAMapWithoutScaleItsScale) {
  const auto truth = eight(80);
  const GeoreferenceInput in = drive_without_scale(truth);
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(scale_of(result.graph.nodes[40].T_world_node), 10, 1e-3);
  EXPECT_LT(largest_error(result, truth), 1e-2);
  ASSERT_TRUE(result.scale);
  EXPECT_NEAR(result.scale->metres_per_unit, 10, 1e-3);
  EXPECT_FALSE(georeference(exact_drive(truth), {}).scale);
}

TEST(Georeference, KnowsTheScaleAsWellAsItSays) {
  const auto truth = eight(80);
  constexpr int kDraws = 8;
  double squares = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Random random(3, static_cast<std::uint64_t>(draw));
    GeoreferenceInput in = drive_without_scale(truth);
    for (std::size_t i = 0; i < in.fixes.size(); ++i) {
      const Eigen::Vector3d noise_m(random.normal(0, 0.5), random.normal(0, 0.5),
                                    random.normal(0, 0.5));
      in.fixes[i] = fix_at(in.fixes[i].stamp_ns, truth[i] * kArm + noise_m);
    }
    for (Constraint& constraint : in.graph.constraints) {
      auto& edge = std::get<RelativePoseConstraint>(constraint);
      Eigen::Matrix<double, 7, 1> error;  // of the stated information
      for (double& component : error) component = random.normal(0, 0.01);
      edge.T_from_to = std::get<Sim3>(edge.T_from_to).plus(error);
    }
    const GeoreferenceResult result = georeference(in, {});
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    const double deviation = (result.scale->metres_per_unit - 10) / result.scale->sigma;
    squares += deviation * deviation / kDraws;
  }
  EXPECT_GT(squares, 0.2);  // chi-squared of 8 draws
  EXPECT_LT(squares, 2.7);
}

TEST(Georeference, RotatesAPlanarMapAboutTheVertical) {
  GeoreferenceInput in;
  in.origin = kOrigin;
  const SE2 T_enu_map(50, -30, 2.0);
  SE2 T_map_node;
  const SE2 step(1, 0, 0.1);
  for (std::int64_t id = 0; id < 40; ++id) {
    in.graph.nodes.push_back({NodeId(id), T_map_node});
    in.visits.push_back({id * kStep_ns, NodeId(id)});
    const Eigen::Vector2d p = T_enu_map * T_map_node.translation();
    in.fixes.push_back(fix_at(id * kStep_ns, {p.x(), p.y(), 7.0 * static_cast<double>(id % 2)}));
    if (id > 0)
      in.graph.constraints.emplace_back(edge_between(NodeId(id - 1), NodeId(id), step, 3));
    T_map_node = T_map_node * step;
  }
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  const SE2 T_enu_first = std::get<SE2>(result.graph.nodes[0].T_world_node);
  EXPECT_NEAR(T_enu_first.translation().x(), 50, 1e-4);
  EXPECT_NEAR(T_enu_first.translation().y(), -30, 1e-4);
  EXPECT_NEAR(T_enu_first.rotation().angle(), 2.0, 1e-5);
}

TEST(Georeference, RejectsGrossErrorsWithoutMovingForThem) {
  const auto truth = eight(80);
  GeoreferenceInput in = exact_drive(truth);
  for (const std::size_t i : {5u, 20u, 21u, 60u})
    in.fixes[i] = fix_at(in.fixes[i].stamp_ns, truth[i] * kArm + Eigen::Vector3d(40, -25, 10));
  in.fixes[33].position = {0, 0, 0};  // on the equator
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.fixes_rejected, 5);
  for (const std::size_t i : {5u, 20u, 21u, 60u, 33u}) EXPECT_TRUE(result.fixes[i].rejected);
  EXPECT_EQ(result.fixes[33].weight, 0);
  EXPECT_NEAR(result.fixes[5].residual_enu.norm(), Eigen::Vector3d(40, -25, 10).norm(), 0.1);
  EXPECT_LT(largest_error(result, truth), 1e-3);
}

TEST(Georeference, PutsAMapThatLagsBehindItsStampsToThem) {
  const auto truth = eight(160);
  GeoreferenceInput in = exact_drive(truth);
  // The node of the time i is where the vehicle was two steps of 0.1 s before.
  for (std::size_t i = 0; i < in.visits.size(); ++i) in.visits[i].stamp_ns += 2 * kStep_ns;
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(result.map_delay_s, 0.2, 0.01);
  // Node i now is where the vehicle was at the time i + 2. At the ends the way is gone on with as
  // it went, through a turn that may have changed.
  double largest = 0;
  for (std::size_t i = 2; i + 4 < truth.size(); ++i)
    largest = std::max(largest, (std::get<SE3>(result.graph.nodes[i].T_world_node).translation() -
                                 truth[i + 2].translation())
                                    .norm());
  EXPECT_LT(largest, 0.2);
  GeoreferenceOptions as_it_is;
  as_it_is.estimate_delay = false;
  EXPECT_EQ(georeference(in, as_it_is).map_delay_s, 0);
}

TEST(Georeference, FindsWhatOdometryIsWorthWhateverItClaims) {
  Random random = test::seeded_random(5);
  const auto truth = eight(300);
  GeoreferenceInput in = exact_drive(truth);
  for (std::size_t i = 0; i < in.fixes.size(); ++i) {
    const Eigen::Vector3d noise(random.normal(0, 0.5), random.normal(0, 0.5),
                                random.normal(0, 0.5));
    in.fixes[i] = fix_at(in.fixes[i].stamp_ns, truth[i] * kArm + noise);
  }
  for (Constraint& constraint : in.graph.constraints)
    std::get<RelativePoseConstraint>(constraint).information = Information::Identity(6, 6);
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(result.odometry_factor_translation, 0.1);
  EXPECT_LT(result.odometry_factor_rotation, 0.01);
  // Exact odometry: 300 fixes of 0.5 m determine six numbers. With a metre a step it would be 0.4
  // m.
  EXPECT_LT(largest_error(result, truth), 0.2);
}

TEST(Georeference, BridgesADropoutAndReportsIt) {
  const auto truth = eight(80);
  GeoreferenceInput in = exact_drive(truth);
  in.fixes.erase(in.fixes.begin() + 30, in.fixes.begin() + 50);
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  ASSERT_EQ(result.dropouts.size(), 1u);
  EXPECT_EQ(result.dropouts[0].begin_ns, 29 * kStep_ns);
  EXPECT_EQ(result.dropouts[0].end_ns, 50 * kStep_ns);
  EXPECT_LT(largest_error(result, truth), 1e-3);
}

TEST(Georeference, UsesNoFixOutsideOfTheMapsTime) {
  const auto truth = eight(80);
  GeoreferenceInput in = exact_drive(truth);
  in.fixes.insert(in.fixes.begin(), fix_at(-kStep_ns, {0, 0, 0}));
  in.fixes.push_back(fix_at(200 * kStep_ns, {0, 0, 0}));
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_FALSE(result.fixes.front().node);
  EXPECT_FALSE(result.fixes.back().node);
  EXPECT_EQ(result.fixes_used, 80);
}

TEST(Georeference, TakesFixesForAsBadAsTheyScatter) {
  Random random = test::seeded_random(5);
  const auto truth = eight(160);
  GeoreferenceInput in = exact_drive(truth);
  for (std::size_t i = 0; i < in.fixes.size(); ++i) {
    Eigen::Vector3d noise;
    for (int k = 0; k < 3; ++k) noise[k] = random.normal(0, k < 2 ? 1.0 : 2.0);
    in.fixes[i] = fix_at(in.fixes[i].stamp_ns, truth[i] * kArm + noise, 0.1);
  }
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  // A median of 160 (vertical) values, each difference used twice, is good to some 15 %.
  EXPECT_NEAR(result.accuracy_factor_horizontal, 10, 3);
  EXPECT_NEAR(result.accuracy_factor_vertical, 20, 6);
  GeoreferenceOptions believing;
  believing.estimate_accuracy = false;
  EXPECT_EQ(georeference(in, believing).accuracy_factor_vertical, 1);
}

TEST(Georeference, FindsLeverArmAndClockTogether) {
  const auto truth = eight(160);
  GeoreferenceInput in = exact_drive(truth);
  // Speeds differ, else a shift in time is one along the way.
  std::int64_t stamp = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    in.visits[i].stamp_ns = stamp;
    in.fixes[i].stamp_ns = stamp - 30'000'000;
    stamp += i % 50 < 25 ? kStep_ns : 3 * kStep_ns;
  }
  in.lever_arm.setZero();
  GeoreferenceOptions options;
  options.estimate_lever_arm = options.estimate_clock_offset = true;
  const GeoreferenceResult result = georeference(in, options);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  // Between nodes the motion is a chord, 1 m long on a radius of 8 m: up to 16 mm beside the arc.
  EXPECT_LT((result.lever_arm - kArm).norm(), 0.1);
  EXPECT_NEAR(result.clock_offset_s, 0.03, 0.005);
  EXPECT_TRUE(result.lever_arm_observable[0]);
  EXPECT_TRUE(result.lever_arm_observable[2]);
}

TEST(Georeference, SaysThatAStraightDriveHidesTheLeverArm) {
  std::vector<SE3> truth;
  for (int i = 0; i < 60; ++i)  // no turn, but a shift sideways and up: the map has an extent
    truth.emplace_back(SO3(), Eigen::Vector3d(i, 10 * std::sin(0.1 * i), 5 * std::cos(0.15 * i)));
  GeoreferenceInput in = exact_drive(truth);
  in.lever_arm.setZero();
  GeoreferenceOptions options;
  options.estimate_lever_arm = true;
  const GeoreferenceResult result = georeference(in, options);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  for (int k = 0; k < 3; ++k) {
    EXPECT_FALSE(result.lever_arm_observable[k]);
    EXPECT_NEAR(std::sqrt(result.lever_arm_covariance(k, k)), options.lever_arm_sigma_m, 0.1);
  }
}

TEST(Georeference, LeavesOutAComponentThatNoFixPlaces) {
  const auto truth = eight(80);
  GeoreferenceInput in = exact_drive(truth);
  in.graph.nodes.push_back({NodeId(100), SE3()});
  in.graph.nodes.push_back({NodeId(101), SE3()});
  in.graph.constraints.emplace_back(edge_between(NodeId(100), NodeId(101), SE3(), 6));
  in.visits.push_back({1000 * kStep_ns, NodeId(100)});
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_THAT(result.unplaced_nodes, ElementsAre(NodeId(100), NodeId(101)));
  EXPECT_EQ(result.graph.nodes.size(), 80u);
  EXPECT_LT(largest_error(result, truth), 1e-3);
}

TEST(Georeference, JoinsComponentsThatFixesPlace) {
  const auto truth = eight(120);
  GeoreferenceInput in = exact_drive(truth);
  in.graph.constraints.erase(in.graph.constraints.begin() + 59);  // 59 -> 60
  const SE3 T_away(SO3::exp({0.3, -1, 2}), {70, 80, -20});
  for (std::size_t i = 60; i < 120; ++i)
    in.graph.nodes[i].T_world_node = T_away * std::get<SE3>(in.graph.nodes[i].T_world_node);
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_TRUE(result.unplaced_nodes.empty());
  EXPECT_LT(largest_error(result, truth), 1e-3);
}

TEST(Georeference, TakesTheMedianOfTheFixesForOrigin) {
  GeoreferenceInput in = exact_drive(eight(81));
  in.origin.reset();
  in.fixes[3].position = {0, 0, 0};
  const GeoreferenceResult result = georeference(in, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(result.origin.latitude_deg, kOrigin.latitude_deg, 0.01);
  EXPECT_NEAR(result.origin.longitude_deg, kOrigin.longitude_deg, 0.01);
}

TEST(Georeference, RefusesWhatTheDataDoNotTell) {
  const auto truth = eight(80);
  GeoreferenceInput none = exact_drive(truth);
  none.fixes.clear();
  EXPECT_EQ(georeference(none, {}).outcome.code, Outcome::Code::kTooFewData);

  GeoreferenceInput later = exact_drive(truth);
  later.clock_offset_s = 1000;
  const GeoreferenceResult apart = georeference(later, {});
  EXPECT_EQ(apart.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_THAT(apart.outcome.reason, HasSubstr("no time in common"));

  std::vector<SE3> straight;
  for (int i = 0; i < 50; ++i) straight.emplace_back(SO3(), Eigen::Vector3d(i, 0, 0));
  EXPECT_EQ(georeference(exact_drive(straight), {}).outcome.code, Outcome::Code::kDegenerate);

  Random random = test::seeded_random(11);
  GeoreferenceInput elsewhere = exact_drive(truth);
  for (GpsFix& fix : elsewhere.fixes)
    fix = fix_at(fix.stamp_ns, {random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), 0});
  EXPECT_EQ(georeference(elsewhere, {}).outcome.code, Outcome::Code::kNoConsensus);

  GeoreferenceOptions one_step;
  one_step.solver.max_iterations = 1;
  GeoreferenceInput bent = exact_drive(truth);
  for (std::size_t i = 30; i < 80; ++i)
    bent.fixes[i] =
        fix_at(bent.fixes[i].stamp_ns,
               truth[i] * kArm + Eigen::Vector3d(0, 0.06 * static_cast<double>(i - 30), 0));
  EXPECT_EQ(georeference(bent, one_step).outcome.code, Outcome::Code::kNotConverged);
}

TEST(Georeference, ThrowsForACallersMistakes) {
  const auto truth = eight(20);
  GeoreferenceInput in = exact_drive(truth);
  in.visits.push_back({0, NodeId(5)});
  EXPECT_THROW((void)georeference(in, {}), ArgumentError);  // two nodes at one time
  in = exact_drive(truth);
  in.visits.push_back({-1, NodeId(77)});
  EXPECT_THROW((void)georeference(in, {}), ArgumentError);  // no such node
  in = exact_drive(truth);
  in.visits.clear();
  EXPECT_THROW((void)georeference(in, {}), ArgumentError);
  in = exact_drive(truth);
  std::swap(in.fixes[3], in.fixes[4]);
  EXPECT_THROW((void)georeference(in, {}), ArgumentError);
  in = exact_drive(truth);
  in.fixes[3].position.latitude_deg = 100;
  EXPECT_THROW((void)georeference(in, {}), ArgumentError);
  GeoreferenceOptions options;
  options.max_gap_s = -1;
  EXPECT_THROW((void)georeference(exact_drive(truth), options), ArgumentError);
}

}  // namespace georeference_test
}  // namespace placegraph
