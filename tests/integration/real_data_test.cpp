#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/run.h>

#include "tests/support/data.h"
#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace real_data_test {

using namespace test;

struct Judged {
  RunResult run;
  Trajectory optimized;
  EvaluationResult result;
};

Judged run_and_judge(const std::string& path, const RunOptions& options,
                     const EvaluationOptions& evaluation) {
  const auto dataset = open_dataset(path);
  Judged judged;
  judged.run = run_sequence(*dataset, options);
  judged.optimized = judged.run.map.trajectory_optimized();
  judged.result = evaluate(*dataset->ground_truth(), judged.optimized, evaluation);
  const EvaluationResult& r = judged.result;
  std::cout << "posed " << r.posed << "/" << r.frames << ", ATE " << r.ape.error_m.rmse
            << " m, t_rel " << r.segments.t_rel_percent << " %, median rotation "
            << r.rpe.rotation_deg.median << " deg\n";
  return judged;
}

EvaluationOptions metric_over(const std::vector<double>& lengths_m) {
  EvaluationOptions options;
  options.alignment = Alignment::kOrigin;
  options.segments.lengths_m = lengths_m;
  options.segments.step = 1;
  return options;
}

TEST(RealData, KittiStereoDriftsLessThanTwoPercent) {
  PLACEGRAPH_DATA_OR_SKIP(path, "sequences/kitti06_stereo51");
  const Judged judged = run_and_judge(path, {}, metric_over({10, 20, 30, 40, 50}));
  EXPECT_EQ(judged.run.sensor, Sensor::kStereo);
  ASSERT_TRUE(judged.result.segments.outcome);
  EXPECT_EQ(judged.optimized.posed(), 51u);
  EXPECT_LE(judged.result.segments.t_rel_percent, 2);
}

TEST(RealData, KittiMonoWithCameraHeightDriftsLessThanFourPercent) {
  PLACEGRAPH_DATA_OR_SKIP(path, "sequences/kitti00_mono200");
  RunOptions options;
  options.camera_height_m = 1.65;
  const Judged judged = run_and_judge(path, options, metric_over({50, 60, 70, 80, 90, 100}));
  EXPECT_TRUE(judged.run.map.metric);
  ASSERT_TRUE(judged.result.segments.outcome);
  EXPECT_EQ(judged.optimized.posed(), 200u);
  EXPECT_LE(judged.result.segments.t_rel_percent, 4);
  EXPECT_LE(judged.result.rpe.rotation_deg.median, 0.1);
}

TEST(RealData, SevenScenesClosesTrueLoopsOnly) {
  PLACEGRAPH_DATA_OR_SKIP(path, "sequences/sevenscenes_rgbd334");
  const Judged judged = run_and_judge(path, {}, {});
  EXPECT_EQ(judged.run.sensor, Sensor::kRgbd);
  EXPECT_EQ(judged.optimized.posed(), 334u);
  EXPECT_EQ(judged.run.map.trajectory_online.posed(), 334u);
  ASSERT_TRUE(judged.result.outcome);
  EXPECT_LE(judged.result.ape.error_m.rmse, 0.10);
  const Trajectory truth = *open_dataset(path)->ground_truth();
  int accepted = 0, right = 0;
  double worst_m = 0, worst_rad = 0;
  for (const LoopRecord& loop : judged.run.map.loops) {
    if (!loop.accepted()) continue;
    ++accepted;
    const auto at = [&](FrameId frame) {
      return SE3(*truth.poses.at(static_cast<std::size_t>(frame.value())).T_world_body);
    };
    const SE3 T_match_query = at(loop.match_frame).inverse() * at(loop.query_frame);
    const double error_m = distance_m(T_match_query, loop.T_match_query);
    const double error_rad = angle_rad(T_match_query, loop.T_match_query);
    worst_m = std::max(worst_m, error_m), worst_rad = std::max(worst_rad, error_rad);
    const bool is_right = std::abs(loop.query_frame.value() - loop.match_frame.value()) >= 33 &&
                          error_m <= 0.10 && error_rad <= deg_to_rad(5);
    right += is_right;
    EXPECT_TRUE(is_right) << "frames " << loop.query_frame << " and " << loop.match_frame << ", "
                          << loop.inliers << " inliers: " << error_m << " m, "
                          << rad_to_deg(error_rad) << " deg off";
  }
  std::cout << accepted << " loops, worst " << worst_m << " m, " << rad_to_deg(worst_rad)
            << " deg\n";
  EXPECT_GE(right, 20);
}

/// Every `step`-th frame of a sequence from `first` on, as `frames` frames.
class SparseDataset : public Dataset {
 public:
  SparseDataset(const std::string& path, std::size_t step, std::size_t first, std::size_t frames)
      : whole_(open_dataset(path)),
        step_(step),
        first_(first),
        frames_(frames),
        truth_(Trajectory()) {
    for (std::size_t i = 0; i < frames_; ++i)
      truth_->poses.push_back(whole_->ground_truth()->poses.at(at(i)));
  }
  const std::string& name() const override { return whole_->name(); }
  const std::string& format() const override { return whole_->format(); }
  std::size_t size() const override { return frames_; }
  std::vector<Sensor> sensors() const override { return whole_->sensors(); }
  Calibration calibration(Sensor sensor) const override { return whole_->calibration(sensor); }
  std::int64_t stamp_ns(std::size_t index) const override { return whole_->stamp_ns(at(index)); }
  const std::optional<Trajectory>& ground_truth() const override { return truth_; }
  Frame frame(std::size_t index, Sensor sensor) const override {
    Frame frame = whole_->frame(at(index), sensor);
    frame.id = FrameId(static_cast<std::int64_t>(index));
    return frame;
  }

 private:
  std::size_t at(std::size_t index) const { return first_ + step_ * index; }
  std::unique_ptr<Dataset> whole_;
  std::size_t step_, first_, frames_;
  std::optional<Trajectory> truth_;
};

/// Largest error of the rotation between consecutive frames that both have a pose.
double worst_step_deg(const Trajectory& truth, const Trajectory& estimate) {
  double worst_rad = 0;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const auto &before = estimate.poses[i - 1].T_world_body, &now = estimate.poses[i].T_world_body;
    if (!before || !now) continue;
    const SE3 estimated = SE3(*before).inverse() * SE3(*now);
    const SE3 true_step =
        SE3(*truth.poses[i - 1].T_world_body).inverse() * SE3(*truth.poses[i].T_world_body);
    worst_rad = std::max(worst_rad, angle_rad(estimated, true_step));
  }
  return rad_to_deg(worst_rad);
}

// Whichever images a walk begins with; of those with every sixth image some begin wrongly.
TEST(RealData, AWrongBeginningOfASparseWalkIsTakenBack) {
  PLACEGRAPH_DATA_OR_SKIP(path, "sequences/sevenscenes_rgbd334");
  RunOptions options;
  options.sensor = SensorChoice::kMono;
  options.lens.enabled = false;
  std::size_t taken_back = 0;
  for (const auto& [step, most_deg] : {std::pair(3, 2.5), std::pair(6, 4.0)})
    for (const std::size_t first : {2, 40, 80, 120, 180, 220}) {
      SCOPED_TRACE(testing::Message() << "every " << step << "th image from " << first);
      const SparseDataset walk(path, static_cast<std::size_t>(step), first, 16);
      const RunResult run = run_sequence(walk, options);
      taken_back += std::ranges::count(run.notes, NoteCause::kScale, &DataNote::cause) > 0;
      std::size_t posed = 0;
      for (const MapComponent& component : run.map.components()) {
        posed += component.posed;
        const Trajectory estimate = run.map.trajectory_optimized(component.number);
        EXPECT_LT(worst_step_deg(*walk.ground_truth(), estimate), most_deg);
      }
      EXPECT_GE(posed, step == 3 ? 12u : 7u);
    }
  EXPECT_GT(taken_back, 0u);
}

TEST(RealData, PlanarBoardIsFollowedToACentimetre) {
  PLACEGRAPH_DATA_OR_SKIP(path, "sequences/cube_planar200");
  EvaluationOptions evaluation;
  evaluation.alignment = Alignment::kScale;
  const Judged judged = run_and_judge(path, {}, evaluation);
  EXPECT_EQ(judged.optimized.posed(), 200u);
  ASSERT_TRUE(judged.result.outcome);
  EXPECT_LE(judged.result.ape.error_m.rmse, 0.01);
}

}  // namespace real_data_test
}  // namespace placegraph
