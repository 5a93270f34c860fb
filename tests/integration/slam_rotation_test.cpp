#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace slam_rotation_test {

using namespace test;

constexpr double kRotationRad = 0.035;  // of a frame

/// `before` frames ahead, then turning on the spot for `turning`, then on along the street. Frames
/// in [dark_begin, dark_end) are black.
StreetDataset path(int before, int rotating, int after, int dark_begin = 0, int dark_end = 0) {
  return StreetDataset(before + rotating + after, dark_begin, dark_end, false, [=](int i) {
    const int path = std::min(i, before) + std::max(0, i - before - rotating);
    const int rotated_steps = std::clamp(i - before, 0, rotating);
    return pose({0, kRotationRad * rotated_steps, 0}, {0, -kStreetHeight_m, 0.25 * path});
  });
}

RunResult run_mono(const StreetDataset& dataset) {
  RunOptions options;
  options.sensor = SensorChoice::kMono;
  options.slam.odometry.points.tracker.max_tracks = 250;
  options.slam.loops.detector.max_features = 400;
  return run_sequence(dataset, options);
}

EvaluationResult judge(const StreetDataset& dataset, const RunResult& run) {
  EvaluationOptions options;
  options.alignment = Alignment::kSim3;
  return evaluate(*dataset.ground_truth(), run.map.trajectory_optimized(), options);
}

/// From the first frame to the last, against the truth.
double rotation_error_deg(const StreetDataset& dataset, const Trajectory& trajectory) {
  const auto total_rotation = [](const Trajectory& t) {
    return SE3(*t.poses.front().T_world_body).rotation().inverse() *
           SE3(*t.poses.back().T_world_body).rotation();
  };
  return rad_to_deg((total_rotation(*dataset.ground_truth()).inverse() * total_rotation(trajectory))
                        .log()
                        .norm());
}

TEST(SlamThatRotatesInPlace, KeepsItsPlaceInTheMapThoughAllItKnewLeavesTheView) {
  const StreetDataset dataset = path(12, 45, 14);  // 90 degrees: it goes on sideways
  const RunResult run = run_mono(dataset);
  const Trajectory optimized = run.map.trajectory_optimized();
  ASSERT_EQ(optimized.posed(), dataset.size());
  EXPECT_LT(rotation_error_deg(dataset, optimized), 0.5);
  for (const Place& place : run.map.place_graph.places) EXPECT_EQ(place.component, 0);
  // Where the unit of length is, after the turn, is a guess.
  const EvaluationResult result = judge(dataset, run);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(result.ape.error_m.rmse, 0.15 * result.path_m);
}

TEST(SlamThatRotatesInPlace, KnowsHowItStoodBeforeItsFirstSecondView) {
  const StreetDataset dataset = path(0, 30, 12);
  const RunResult run = run_mono(dataset);
  const Trajectory optimized = run.map.trajectory_optimized();
  ASSERT_EQ(optimized.posed(), dataset.size());
  EXPECT_LT(rotation_error_deg(dataset, optimized), 0.5);
  const EvaluationResult result = judge(dataset, run);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(result.ape.error_m.rmse, 0.02 * result.path_m);
}

TEST(SlamThatRotatesInPlace, ForgetsWhatItSawBeforeTheDarkIfNothingWasPlacedYet) {
  const StreetDataset dataset = path(0, 24, 12, 16, 20);
  const RunResult run = run_mono(dataset);
  // Whatever is posed hangs together: the dark tells nothing of how it turned there.
  for (const Trajectory& trajectory : {run.map.trajectory_online, run.map.trajectory_optimized()}) {
    EXPECT_TRUE(trajectory.poses.back().T_world_body);
    for (std::size_t i = 0; i < dataset.size(); ++i) {
      const auto& pose = trajectory.poses[i].T_world_body;
      if (!pose) continue;
      const auto& truth = dataset.ground_truth()->poses;
      const SO3 estimated_rotation =
          SE3(*pose).rotation().inverse() * SE3(*trajectory.poses.back().T_world_body).rotation();
      const SO3 expected = SE3(*truth[i].T_world_body).rotation().inverse() *
                           SE3(*truth.back().T_world_body).rotation();
      EXPECT_LT(rad_to_deg((expected.inverse() * estimated_rotation).log().norm()), 0.7)
          << "frame " << i;
    }
  }
}

}  // namespace slam_rotation_test
}  // namespace placegraph
