#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/data.h"

namespace placegraph {
namespace golden_test {

// Published rows of KITTI 00, computed by an independent script: to half a unit of the last digit.
struct Golden {
  const char* file;
  double t_rel_percent, r_rel_deg_per_100m, ate_se3_m, ate_sim3_m;
};

EvaluationResult expect_golden(const std::string& folder, const Golden& golden) {
  const Trajectory truth = read_trajectory(folder + "/KITTI_00_gt.txt");
  const Trajectory estimate = read_trajectory(folder + "/" + golden.file);
  const EvaluationResult se3 = evaluate(truth, estimate);
  EXPECT_TRUE(se3.outcome) << se3.outcome.reason;
  EXPECT_NEAR(se3.segments.t_rel_percent, golden.t_rel_percent, 5e-6);
  EXPECT_NEAR(se3.segments.r_rel_deg_per_100m, golden.r_rel_deg_per_100m, 5e-6);
  EXPECT_NEAR(se3.ape.error_m.rmse, golden.ate_se3_m, 5e-6);
  EXPECT_EQ(se3.posed, 4541);
  EvaluationOptions options;
  options.alignment = Alignment::kSim3;
  const EvaluationResult sim3 = evaluate(truth, estimate, options);
  EXPECT_NEAR(sim3.ape.error_m.rmse, golden.ate_sim3_m, 5e-6);
  return se3;
}

TEST(Golden, ReproducesTheFiguresOfOrbSlam2StereoOnKitti00) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "golden");
  const EvaluationResult se3 =
      expect_golden(folder, {"KITTI_00_ORB.txt", 0.69973, 0.25333, 1.30345, 0.93771});
  EXPECT_THAT(se3.warnings, ::testing::IsEmpty());
  EvaluationOptions options;
  options.alignment = Alignment::kSim3;
  EXPECT_NEAR(evaluate(read_trajectory(folder + "/KITTI_00_gt.txt"),
                       read_trajectory(folder + "/KITTI_00_ORB.txt"), options)
                  .alignment.scale,
              1.004698, 5e-7);
}

TEST(Golden, ReproducesTheFiguresOfSptamOnKitti00) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "golden");
  const EvaluationResult se3 =
      expect_golden(folder, {"KITTI_00_SPTAM.txt", 1.48696, 0.55771, 3.73849, 3.63529});
  // The published file runs one frame ahead of the ground truth: its line i is the pose of i + 1.
  EXPECT_THAT(se3.warnings, ::testing::ElementsAre(::testing::HasSubstr("1 frame later")));
}

}  // namespace golden_test
}  // namespace placegraph
