#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace slam_surfaces_test {

using namespace test;

const StreetDataset& drive() {
  static const StreetDataset dataset(20, 0, 0, false);
  return dataset;
}

RunOptions run_by(const char* cues, SensorChoice sensor) {
  RunOptions options;
  options.sensor = sensor;
  options.slam.odometry.cues = cues;
  options.slam.odometry.points.tracker.max_tracks = 250;
  options.slam.loops.detector.max_features = 400;
  return options;
}

/// Share of the way by which the trajectory errs, nothing fitted.
double error_share(const RunResult& run) {
  EvaluationOptions options;
  options.alignment = Alignment::kOrigin;
  const EvaluationResult result =
      evaluate(*drive().ground_truth(), run.map.trajectory_optimized(), options);
  EXPECT_TRUE(result.outcome) << result.outcome.reason;
  return result.ape.error_m.rmse / result.path_m;
}

TEST(SlamBySurfaces, PosesEveryFrameByTheGroundWithStereo) {
  const RunResult run = run_sequence(drive(), run_by("plane", SensorChoice::kStereo));
  EXPECT_EQ(run.map.trajectory_online.posed(), drive().size());
  EXPECT_TRUE(run.map.metric);
  EXPECT_LT(error_share(run), 0.03);
  EXPECT_GE(run.map.keyframes.size(), 3u);
  for (const RelativePoseConstraint& c : run.map.place_graph.constraints)
    EXPECT_GT(c.information.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

TEST(SlamBySurfaces, PosesEveryFrameByTheGroundWithOneCameraOfKnownHeight) {
  RunOptions options = run_by("plane", SensorChoice::kMono);
  options.camera_height_m = kStreetHeight_m;
  const RunResult run = run_sequence(drive(), options);
  EXPECT_EQ(run.map.trajectory_online.posed(), drive().size());
  EXPECT_TRUE(run.map.metric);
  EXPECT_LT(error_share(run), 0.05);
}

TEST(SlamBySurfaces, PosesEveryFrameBySeveralPlanes) {
  const RunResult run = run_sequence(drive(), run_by("direct", SensorChoice::kStereo));
  EXPECT_EQ(run.map.trajectory_online.posed(), drive().size());
  EXPECT_LT(error_share(run), 0.03);
}

TEST(SlamBySurfaces, SeveralPlanesDoNoHarmBesidePoints) {
  const RunResult without = run_sequence(drive(), run_by("points", SensorChoice::kStereo));
  const RunResult with =
      run_sequence(drive(), run_by("points,plane,direct", SensorChoice::kStereo));
  EXPECT_EQ(with.map.trajectory_online.posed(), drive().size());
  EXPECT_LT(error_share(with), error_share(without) + 0.002);
}

TEST(SlamBySurfaces, MonocularNeedsItsHeight) {
  EXPECT_THROW((void)run_sequence(drive(), run_by("plane", SensorChoice::kMono)), ArgumentError);
}

TEST(SlamBySurfaces, AreLostInTheDarkAndSaySo) {
  const StreetDataset dataset(16, 8, 11);
  std::vector<std::string> lost;
  RunInputs inputs;
  inputs.log = [&](LogLevel, const std::string& message) {
    if (message.find(" lost:") != message.npos) lost.push_back(message);
  };
  const RunResult run = run_sequence(dataset, run_by("plane", SensorChoice::kStereo), inputs);
  EXPECT_EQ(lost.size(), 3u);
  for (const std::string& message : lost)
    EXPECT_GT(message.size(), message.find("lost: ") + 6) << message << " gives no reason";
  for (int i = 8; i < 11; ++i)
    EXPECT_FALSE(run.map.trajectory_online.poses[static_cast<std::size_t>(i)].T_world_body);
  EXPECT_TRUE(run.map.trajectory_online.poses[7].T_world_body);
}

}  // namespace slam_surfaces_test
}  // namespace placegraph
