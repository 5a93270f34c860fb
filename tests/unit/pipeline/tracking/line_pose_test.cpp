#include <gtest/gtest.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/tracking/line_pose.h>

#include "tests/support/scenes/boards.h"

namespace placegraph {
namespace line_pose_test {

using namespace test;

constexpr double kBaseline_m = 0.5, kDepth_m = 5;
constexpr int kFar = 3;  // the frame after a leap

SE3 path(int i) {
  return i == kFar ? pose({0, 0.01, 0}, {0.05, -0.02, 0.75})
                   : pose({0, 0.004 * i, 0}, {0.03 * i, -0.01 * i, 0.12 * i});
}

const std::vector<Frame>& drive() {
  static const std::vector<Frame> frames = boards_frames(4, path, kBaseline_m);
  return frames;
}

/// Lines of a stereo keyframe at frame 0, placed by their disparities.
struct Lines {
  Calibration calibration;
  LineCue cue;
  SlidingWindow window;
  Random random{1};

  Lines() : calibration(stereo()), cue({}, calibration, {}), window({}, calibration.camera) {
    window.add_keyframe(KeyframeId(0), path(0));
    cue.observe(KeyframeId(0), drive()[0], {}, kDepth_m, window);
  }
  static Calibration stereo() {
    Calibration calibration;
    calibration.camera = boards_camera();
    calibration.baseline_m = kBaseline_m;
    return calibration;
  }
  PoseFromLines pose(int i, const MotionModel& motion, const Pose3d2dResult& points = no_points()) {
    return pose_with_lines(cue, drive()[static_cast<std::size_t>(i)].image, window, motion, points,
                           kDepth_m, random);
  }
  static Pose3d2dResult no_points() {
    Pose3d2dResult points;
    points.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no points");
    return points;
  }
};
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(LinePose, LinesAloneFollowAKnownMotion) {
  Lines lines;
  ASSERT_GT(lines.window.lines().size(), 15u);
  const MotionModel motion(path(0), path(0).inverse() * path(kFar));
  const PoseFromLines found = lines.pose(kFar, motion);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_LT(error(found.T_ref_cam, path(kFar)), 0.03);
  EXPECT_GT(found.inliers.size(), 10u);
  EXPECT_GT(lines.cue.followed(lines.window), 10);
  // They are followed into the image.
  EXPECT_GT(median_of(lines.cue.flow_px()), 2);
}

TEST(LinePose, WithoutAVelocitySeveralWaysAheadAreTried) {
  Lines lines;
  // 0.75 m in one frame, which is 0.15 of the depth.
  const PoseFromLines found = lines.pose(kFar, MotionModel(path(0)));
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  // To a fifth of the leap: few lines are found so far from where any guess has them.
  EXPECT_LT(error(found.T_ref_cam, path(kFar)), 0.15);
}

TEST(LinePose, PointsSayWhereLinesAreSought) {
  Lines lines;
  Pose3d2dResult points;
  points.outcome = Outcome::ok();
  points.T_ref_cam = path(2) * pose({0, 0.001, 0}, {0.01, 0, 0.01});
  points.information = 100 * Matrix6d::Identity();  // a decimetre
  // The motion model is far off, and is not asked.
  const PoseFromLines found =
      lines.pose(2, MotionModel(path(0), pose({0, 0.3, 0}, {0, 0, -2})), points);
  ASSERT_TRUE(found.outcome);
  EXPECT_LT(error(found.T_ref_cam, path(2)), 0.02);
}

TEST(LinePose, APoseOfManyPointsHolds) {
  Lines lines;
  Pose3d2dResult points;
  points.outcome = Outcome::ok();
  points.T_ref_cam = path(1) * pose({0, 0, 0}, {0, 0, 0.03});
  points.information = 1e10 * Matrix6d::Identity();
  const PoseFromLines found = lines.pose(1, MotionModel(path(0)), points);
  ASSERT_TRUE(found.outcome);
  EXPECT_LT(error(found.T_ref_cam, points.T_ref_cam), 1e-3);
}

TEST(LinePose, WhereLinesTellNothingTheAnswerIsThatOfThePoints) {
  Lines lines;
  Pose3d2dResult points;
  points.outcome = Outcome::ok();
  points.T_ref_cam = path(1);
  points.information = 1e4 * Matrix6d::Identity();
  const Image dark(boards_camera().height, boards_camera().width, CV_8UC1, cv::Scalar(0));
  const PoseFromLines found = pose_with_lines(lines.cue, dark, lines.window, MotionModel(path(0)),
                                              points, kDepth_m, lines.random);
  ASSERT_TRUE(found.outcome);
  EXPECT_LT(error(found.T_ref_cam, path(1)), 1e-12);
  EXPECT_EQ(found.information, points.information);
  EXPECT_TRUE(found.inliers.empty());
}

TEST(LinePose, WithoutLinesAndPointsThereIsNoPose) {
  Lines lines;
  const Image dark(boards_camera().height, boards_camera().width, CV_8UC1, cv::Scalar(0));
  EXPECT_FALSE(pose_with_lines(lines.cue, dark, lines.window, MotionModel(path(0)),
                               Lines::no_points(), kDepth_m, lines.random)
                   .outcome);
}

}  // namespace line_pose_test
}  // namespace placegraph
