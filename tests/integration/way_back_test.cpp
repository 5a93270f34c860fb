// The way back in a small rendered town: a map is made of a round and a bit, and the way back over
// its places is replayed with frames that it does not keep.
#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/eval/loops/route_check.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/run.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/way_back.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace way_back_test {

using test::Recognition;

constexpr int kRound = 96, kFrames = 150, kMapFrames = 130;
constexpr double kRadius_m = 14;

/// A round street driven one and a half times, half a metre further out the second time.
Trajectory rounds() {
  Trajectory truth;
  truth.has_times = false;
  for (int i = 0; i < kFrames; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRound;
    const double radius = kRadius_m + 0.5 * std::clamp((i - 60.0) / 30, 0.0, 1.0);
    const Eigen::Vector3d at(kRadius_m - radius * std::cos(angle), 0, radius * std::sin(angle));
    truth.poses.push_back({i, SE3(SO3::exp({0, angle, 0}), at).isometry()});
  }
  return truth;
}

/// A rendered world as a recorded sequence in memory.
class RenderedDataset : public Dataset {
 public:
  explicit RenderedDataset(const SyntheticOptions& options)
      : world_(options), truth_(world_.ground_truth()) {
    for (std::size_t i = 0; i < world_.size(); ++i)
      frames_.push_back(world_.render(i, {.right = true}).frame);
  }
  const std::string& name() const override { return world_.name(); }
  const std::string& format() const override { return world_.name(); }
  std::size_t size() const override { return frames_.size(); }
  std::vector<Sensor> sensors() const override { return {Sensor::kStereo}; }
  Calibration calibration(Sensor) const override {
    Calibration calibration = world_.calibration();
    calibration.depth.reset();
    return calibration;
  }
  std::int64_t stamp_ns(std::size_t index) const override { return world_.stamp_ns(index); }
  Frame frame(std::size_t index, Sensor) const override { return frames_.at(index); }
  const std::optional<Trajectory>& ground_truth() const override { return truth_; }

 private:
  SyntheticWorld world_;
  std::optional<Trajectory> truth_;
  std::vector<Frame> frames_;
};

TEST(WayBackThroughARenderedTown, IsTheShortestAndEveryPlaceOnItIsRecognized) {
  const test::TemporaryFolder folder;
  const std::string poses = folder / "poses.txt";
  write_trajectory(poses, rounds(), TrajectoryFormat::kKitti);
  SyntheticOptions world;
  world.world = poses;
  world.width = 496;
  world.height = 150;
  const RenderedDataset dataset(world);
  ASSERT_EQ(dataset.size(), static_cast<std::size_t>(kFrames));

  RunOptions options;
  options.max_frames = kMapFrames;
  options.slam.odometry.points.tracker.max_tracks = 300;
  options.slam.loops.detector.max_features = 600;
  const RunResult run = run_sequence(dataset, options);
  const auto frames = test::frames_of_places(run.map);
  ASSERT_GE(frames.size(), 12u);

  // Ways: with a loop closed, no place is further off than half a round.
  Trajectory truth = *dataset.ground_truth();
  truth.poses.resize(kMapFrames);
  const RouteCheck check = check_routes(run.map.place_graph, frames, truth);
  EXPECT_EQ(check.apart, 0);
  EXPECT_EQ(check.same_places, check.pairs);
  EXPECT_LT(check.worst_length_error, 0.03);
  EXPECT_GT(check.within_5_percent, 0.7 * check.pairs);
  const PlaceId first = run.map.place_graph.places.front().id,
                last = run.map.place_graph.places.back().id;
  const Route back = backtracked(shortest_route(run.map.place_graph, first, last));
  ASSERT_TRUE(back.outcome);
  EXPECT_EQ(back.steps.back().place, first);
  EXPECT_LT(back.length_m(), std::numbers::pi * kRadius_m);

  // Recognition: every step from where the camera was at other times, one of them a metre aside.
  const LoopCloser memory(options.slam.loops, run.calibration, options.slam.seed, run.map);
  const test::ReturnPath replay(run.map, memory, dataset, run.sensor, kMapFrames);
  int other_passes = 0;
  for (const auto& [place, frame] : frames) {
    const test::ViewOnThePath view = replay.view_at(frame.value());
    EXPECT_NE(FrameId(view.frame), frame);
    other_passes += view.another_pass;
    const Recognition seen = replay.recognize(view);
    EXPECT_EQ(seen.result, Recognition::Result::kRight)
        << "place " << place << ", view " << view.frame;
    EXPECT_LT(seen.position_error_m, 0.2) << "place " << place;
  }
  EXPECT_GE(other_passes, 2);

  // And nothing where there is nothing to be recognized.
  Frame elsewhere = dataset.frame(0, run.sensor);
  cv::flip(elsewhere.image, elsewhere.image, 0);
  EXPECT_FALSE(memory.relocalize(elsewhere, 0));
}

}  // namespace way_back_test
}  // namespace placegraph
