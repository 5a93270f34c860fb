#include <placegraph/pipeline/results/run_judgement.h>

#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>

#include <nlohmann/json.hpp>

#include "tests/support/scenes/posed_map.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace run_judgement_test {

/// A map of every second frame of a drive, from the third on; all frames have a pose.
Map map_of(const Trajectory& truth) {
  std::vector<SE3> poses;
  for (std::size_t i = 2; i < truth.size(); i += 2)
    poses.emplace_back(*truth.poses[i].T_world_body);
  Map map = test::posed_map(poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Keyframe& keyframe = map.keyframes[i];
    keyframe.frame = FrameId(static_cast<std::int64_t>(2 * i + 2));
    map.frames.push_back({keyframe.frame, keyframe.stamp_ns, keyframe.id, SE3(), 40});
    map.trajectory_online.poses.push_back({keyframe.stamp_ns, poses[i].isometry()});
  }
  return map;
}

/// The estimate in another frame, with a scale.
Trajectory moved(const SE3& T, double scale, Trajectory trajectory) {
  for (StampedPose& pose : trajectory.poses)
    if (pose.T_world_body) {
      pose.T_world_body->translation() *= scale;
      pose.T_world_body = T.isometry() * *pose.T_world_body;
    }
  return trajectory;
}

double distance(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

class RunJudgement : public ::testing::Test {
 protected:
  const Trajectory truth = test::winding_drive(41);
  const Map map = map_of(truth);
  const Trajectory estimate = truth_of_frames(truth, map);
};

TEST_F(RunJudgement, TheTruthOfAMapIsThatOfItsFrames) {
  ASSERT_EQ(estimate.size(), 20U);
  for (std::size_t i = 0; i < estimate.size(); ++i)
    EXPECT_EQ(estimate.poses[i].stamp_ns, truth.poses[2 * i + 2].stamp_ns);
  EXPECT_EQ(truth_of_frames(truth, Map()).size(), 0U);
}

// The positions of the drive are some 40 m wide: rounding errors are below 1e-12 of that.
TEST_F(RunJudgement, BothFitsFindTheMotionBetweenTheFrames) {
  constexpr double kRounding = 1e-9;
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    Vector6d xi;
    for (double& value : xi) value = random.uniform(-2, 2);
    const SE3 T_map_truth = SE3::exp(xi);
    Trajectory given = moved(T_map_truth, 1, estimate);
    EXPECT_LT(distance(fit_by_first_pose(truth, map, given), T_map_truth.inverse()), kRounding);
    EXPECT_LT(distance(fit_by_positions(truth, map, given), T_map_truth.inverse()), kRounding);
    for (const std::size_t lost : {0U, 1U, 7U}) given.poses[lost].T_world_body.reset();
    EXPECT_LT(distance(fit_by_first_pose(truth, map, given), T_map_truth.inverse()), kRounding);
    EXPECT_LT(distance(fit_by_positions(truth, map, given), T_map_truth.inverse()), kRounding);
  }
}

TEST_F(RunJudgement, TheFirstPoseDecidesAloneOrAllPositionsDo) {
  Trajectory bent = estimate;
  for (std::size_t i = 1; i < bent.size(); ++i)
    bent.poses[i].T_world_body->translation() += Eigen::Vector3d(1, 0, 0);
  EXPECT_LT(distance(fit_by_first_pose(truth, map, bent), SE3()), 1e-9);
  EXPECT_GT(distance(fit_by_positions(truth, map, bent), SE3()), 0.5);
}

TEST_F(RunJudgement, WithoutCommonPosesAFitIsTheIdentity) {
  Trajectory lost = estimate;
  for (StampedPose& pose : lost.poses) pose.T_world_body.reset();
  for (const Trajectory& given : {lost, Trajectory()}) {
    EXPECT_EQ(distance(fit_by_first_pose(truth, map, given), SE3()), 0);
    EXPECT_EQ(distance(fit_by_positions(truth, map, given), SE3()), 0);
    EXPECT_EQ(distance(fit_by_first_pose({}, map, estimate), SE3()), 0);
  }
}

TEST_F(RunJudgement, AScaleIsAnErrorOfAllAlignmentsButOne) {
  RunResult run;
  run.sensor = Sensor::kStereo;
  run.map = map;
  for (const bool metric : {false, true}) {
    run.map.metric = metric;
    const nlohmann::json judged = judge_run(truth, run, moved(SE3(), 2, estimate));
    EXPECT_DOUBLE_EQ(judged["path_m"], estimate.path_length());
    EXPECT_EQ(judged.contains("loop_check"), metric);
    const nlohmann::json& by = judged["evaluation"];
    EXPECT_LT(by["sim3"]["ate_rmse_m"].get<double>(), 1e-9) << by;
    EXPECT_GT(by["se3"]["ate_rmse_m"].get<double>(), 1);
    EXPECT_GT(by["origin"]["ate_rmse_m"].get<double>(), by["se3"]["ate_rmse_m"].get<double>());
  }
  EXPECT_EQ(judge_run(truth, run, estimate)["loop_check"]["max_translation_m"], 1);
  const nlohmann::json refused = judge_run(truth, run, moved(SE3(), 0, estimate));
  EXPECT_FALSE(refused["evaluation"]["sim3"]["refused"].get<std::string>().empty());
}

}  // namespace run_judgement_test
}  // namespace placegraph
