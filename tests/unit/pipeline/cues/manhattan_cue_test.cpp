#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>

#include "tests/support/scenes/boards.h"
#include "tests/support/scenes/corridor_view.h"

namespace placegraph {
namespace manhattan_cue_test {

/// A keyframe that sees the corridor, or other edges.
struct Keyframe0 {
  test::CorridorView corridor{true};
  SlidingWindow window{SlidingWindowOptions{}, corridor.camera};
  ManhattanCue cue{{}, corridor.camera, 1, {}};

  Keyframe0() { window.add_keyframe(KeyframeId(0), SE3()); }
  void see(const std::vector<LineSegment>& segments) {
    const Image grey(corridor.camera.height, corridor.camera.width, CV_8UC1, cv::Scalar(128));
    cue.observe(KeyframeId(0), grey, segments, window);
  }
  /// Of the ground that is `half_width` wide to both sides, from 3.5 to 8 m ahead.
  std::vector<Eigen::Vector2d> lane(double half_width) const {
    std::vector<Eigen::Vector2d> outline;
    for (const auto& [x, z] : {std::pair(-half_width, 3.5), std::pair(-half_width, 8.0),
                               std::pair(half_width, 8.0), std::pair(half_width, 3.5)})
      outline.push_back(*corridor.camera.project(
          corridor.R_cam_manhattan * Eigen::Vector3d(x, test::CorridorView::kHeight_m, z)));
    return outline;
  }
};

TEST(ManhattanCueGround, IsTheLevelFloorBetweenWalls) {
  Keyframe0 keyframe;
  keyframe.see(keyframe.corridor.segments);
  const GroundMask ground = keyframe.cue.ground(keyframe.lane(2));
  ASSERT_TRUE(ground.level);
  const Eigen::Vector3d down = keyframe.corridor.R_cam_manhattan * Eigen::Vector3d::UnitY();
  EXPECT_LT(std::acos(std::min(1.0, ground.level->dot(down))), deg_to_rad(0.1));
  EXPECT_GT(ground.level_sigma_rad, 0);
  EXPECT_LT(ground.level_sigma_rad, deg_to_rad(0.5));
  ASSERT_EQ(ground.mask.size(), cv::Size(640, 480));
  const auto at = [&](double x, double y, double z) {
    const Eigen::Vector2d px = *keyframe.corridor.camera.project(keyframe.corridor.R_cam_manhattan *
                                                                 Eigen::Vector3d(x, y, z));
    return static_cast<int>(
        ground.mask.at<std::uint8_t>(static_cast<int>(px[1]), static_cast<int>(px[0])));
  };
  for (const double z : {4.2, 5.2, 6.2}) {
    EXPECT_EQ(at(0, 1.4, z), 255) << z;
    for (const double side : {-1.2, 1.2}) EXPECT_EQ(at(side, 0.6, z), 0) << z;
  }
}

TEST(ManhattanCueGround, IsNothingSpecialWhereNoWallsStandOnIt) {
  Keyframe0 keyframe;
  keyframe.see(keyframe.corridor.segments);
  const GroundMask narrow = keyframe.cue.ground(keyframe.lane(0.5));
  EXPECT_TRUE(narrow.mask.empty());
  EXPECT_FALSE(narrow.level);
  EXPECT_TRUE(keyframe.cue.ground({{-900, 10}, {-800, 10}, {-850, 90}}).mask.empty());
}

TEST(ManhattanCueGround, IsForgottenWithItsKeyframe) {
  Keyframe0 keyframe;
  keyframe.see(keyframe.corridor.segments);
  ASSERT_TRUE(keyframe.cue.ground(keyframe.lane(2)).level);
  keyframe.see({});
  EXPECT_FALSE(keyframe.cue.ground(keyframe.lane(2)).level);
  keyframe.see(keyframe.corridor.segments);
  keyframe.cue.reset();
  EXPECT_TRUE(keyframe.cue.ground(keyframe.lane(2)).mask.empty());
}

SE3 boards_path(int k) { return test::pose({0.01, 0.05 * k, 0}, {0.05 * k, -0.02 * k, 0.15 * k}); }
const Image& boards_view(int k) {
  static const std::vector<Frame> frames = test::boards_frames(5, boards_path);
  return frames[static_cast<std::size_t>(k)].image;
}
constexpr int kBegins = 3;  // views that a Manhattan frame begins with

/// Keyframes on a way through a corridor of boards, whose edges run along three axes.
struct Walk {
  SlidingWindow window{SlidingWindowOptions{}, test::boards_camera()};
  ManhattanCue cue{{}, test::boards_camera(), 1, {}};

  explicit Walk(int keyframes) {
    for (int k = 0; k < keyframes; ++k) see(k);
  }
  void see(int k) {
    window.add_keyframe(KeyframeId(k), boards_path(k));
    cue.observe(KeyframeId(k), boards_view(k), std::nullopt, window);
    if (k > 0) {
      const SE3 T = boards_path(k - 1).inverse() * boards_path(k);
      add_motion(window, {KeyframeId(k - 1), KeyframeId(k), T, 1e6 * Matrix6d::Identity()});
      EXPECT_TRUE(window.optimize().outcome);
    }
    cue.settle(window);
  }
  std::optional<ManhattanCue::RotationEstimate> manhattan_rotation(int frame,
                                                                   const SO3& R_odom_cam) const {
    return cue.manhattan_rotation(boards_view(frame), R_odom_cam, window,
                                  window.keyframes().back());
  }
};

TEST(ManhattanCue, EdgesOfSeveralKeyframesBeginAManhattanFrame) {
  Walk walk(1);
  EXPECT_TRUE(walk.window.manhattan_frames().empty());
  for (int k = 1; k < kBegins; ++k) walk.see(k);
  ASSERT_FALSE(walk.window.manhattan_frames().empty());
  const SO3 R = *walk.window.manhattan_frame(walk.window.manhattan_frames().back());
  // The corridor's axes are those of the odometry, up to their names.
  EXPECT_LT((R.matrix() - R.matrix().array().round().matrix()).norm(), 0.02);
  int along[3] = {0, 0, 0};
  for (const FrameView::DirectedLine& line : walk.cue.view())
    if (line.axis) ++along[*line.axis];
  EXPECT_GE(std::min({along[0] + along[1], along[1] + along[2], along[0] + along[2]}), 10);
}

TEST(ManhattanCue, AFrameIsRotatedToWhereItsEdgesPoint) {
  const Walk walk(4);
  const SO3 truth = boards_path(4).rotation();
  for (const Eigen::Vector3d& off : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.005, -0.01, 0)}) {
    const auto manhattan_rotation = walk.manhattan_rotation(4, truth * SO3::exp(off));
    ASSERT_TRUE(manhattan_rotation);
    const SO3 R_odom_cam = *walk.window.manhattan_frame(manhattan_rotation->manhattan_frame) *
                           manhattan_rotation->R_cam_frame.inverse();
    EXPECT_LT((R_odom_cam.inverse() * truth).log().norm(), deg_to_rad(0.3));
    // A deviation between a hundredth of a degree and one degree about each axis.
    const Eigen::Vector3d sigma = manhattan_rotation->information.inverse().diagonal().cwiseSqrt();
    EXPECT_GT(sigma.minCoeff(), deg_to_rad(0.01));
    EXPECT_LT(sigma.maxCoeff(), deg_to_rad(1));
  }
}

TEST(ManhattanCue, WithoutAManhattanFrameThereIsNoHeading) {
  EXPECT_FALSE(Walk(1).manhattan_rotation(1, boards_path(1).rotation()));
  Walk walk(4);
  // So far from where it is expected it is no sighting of it.
  EXPECT_FALSE(walk.manhattan_rotation(4, boards_path(4).rotation() * SO3::exp({0.2, 0, 0.3})));
  walk.cue.reset();
  EXPECT_FALSE(walk.manhattan_rotation(4, boards_path(4).rotation()));
  EXPECT_TRUE(walk.cue.view().empty());
}

TEST(ManhattanCue, WideImagesAreHalvedAndTheirEdgesAreNot) {
  ManhattanCueOptions options;
  options.max_width_px = 300;
  ManhattanCue halved(options, test::boards_camera(), 1, {});
  SlidingWindow window({}, test::boards_camera());
  window.add_keyframe(KeyframeId(0), boards_path(0));
  halved.observe(KeyframeId(0), boards_view(0), std::nullopt, window);
  const Walk whole(1);
  // Most edges of the halved image lie on one of the whole image.
  int found = 0;
  for (const FrameView::DirectedLine& line : halved.view())
    for (const FrameView::DirectedLine& other : whole.cue.view()) {
      const bool parallel =
          std::abs(line.segment.direction().dot(other.segment.direction())) > 0.999;
      if (parallel && std::abs(other.segment.offset_of(line.segment.middle())) < 0.5) {
        ++found;
        break;
      }
    }
  ASSERT_GT(halved.view().size(), 20u);
  EXPECT_GT(found, 0.7 * static_cast<double>(halved.view().size()));
}

TEST(ManhattanCue, RefusesFaultyOptions) {
  ManhattanCueOptions options;
  options.max_sigma_deg = 0;
  EXPECT_THROW(ManhattanCue(options, test::boards_camera(), 1, {}), ArgumentError);
}

/// A pose and a heading that disagrees with it by `off` in the camera's axes.
struct Rotated {
  SlidingWindow window{SlidingWindowOptions{}, test::boards_camera()};
  SE3 T_odom_cam = test::pose({0.1, 0.4, -0.2}, {1, 2, 3});
  ManhattanCue::RotationEstimate manhattan_rotation;

  explicit Rotated(const Eigen::Vector3d& off, double information) {
    window.add_keyframe(KeyframeId(0), SE3());
    const SO3 R_odom_manhattan = SO3::exp({0, 0.3, 0});
    window.add_manhattan_frame(ManhattanFrameId(7), R_odom_manhattan);
    manhattan_rotation.manhattan_frame = ManhattanFrameId(7);
    manhattan_rotation.R_cam_frame =
        (T_odom_cam.rotation() * SO3::exp(off)).inverse() * R_odom_manhattan;
    manhattan_rotation.information = information * Eigen::Matrix3d::Identity();
  }
};

TEST(WithHeading, APoseGoesAsFarAsItsInformationLetsIt) {
  const Eigen::Vector3d off(0.01, -0.02, 0.005);
  const Rotated rotated(off, 300);
  const SE3 T = with_manhattan_rotation(rotated.T_odom_cam, 100 * Matrix6d::Identity(),
                                        rotated.manhattan_rotation, rotated.window);
  // Three parts of four towards the heading; the position has no reason to move.
  const Eigen::Vector3d step = (rotated.T_odom_cam.rotation().inverse() * T.rotation()).log();
  EXPECT_LT((step - 0.75 * off).norm(), 1e-4);
  EXPECT_LT((T.translation() - rotated.T_odom_cam.translation()).norm(), 1e-9);
}

TEST(WithHeading, ThePositionFollowsTheRotation) {
  const Rotated rotated({0, 0.01, 0}, 1e9);
  // x and the turn about y are known as their sum alone: what one gains the other loses.
  Matrix6d information = 1e-3 * Matrix6d::Identity();
  Vector6d sum = Vector6d::Zero();
  sum[0] = 1, sum[4] = 2;
  information += 100 * sum * sum.transpose();
  const SE3 T = with_manhattan_rotation(rotated.T_odom_cam, information, rotated.manhattan_rotation,
                                        rotated.window);
  const Eigen::Vector3d moved = rotated.T_odom_cam.rotation().inverse() *
                                (T.translation() - rotated.T_odom_cam.translation());
  EXPECT_NEAR(moved.x(), -0.02, 1e-4);
}

TEST(WithHeading, HeadingsKnownAboutOneAxisRotateAboutThatAlone) {
  const Eigen::Vector3d off(0.01, 0.01, 0.01);
  Rotated rotated(off, 0);
  // In the Manhattan frame's axes; the camera's y is what it knows.
  const Eigen::Vector3d y =
      rotated.manhattan_rotation.R_cam_frame.inverse() * Eigen::Vector3d::UnitY();
  rotated.manhattan_rotation.information = 1e9 * y * y.transpose();
  const SE3 T = with_manhattan_rotation(rotated.T_odom_cam, Matrix6d::Identity(),
                                        rotated.manhattan_rotation, rotated.window);
  const Eigen::Vector3d step = (rotated.T_odom_cam.rotation().inverse() * T.rotation()).log();
  EXPECT_LT((step - Eigen::Vector3d(0, 0.01, 0)).norm(), 2e-4);
}

TEST(WithHeading, WithoutAHeadingOrItsManhattanFrameAPoseStays) {
  Rotated rotated({0, 0.1, 0}, 1e6);
  const Matrix6d information = Matrix6d::Identity();
  const auto moved = [&](const std::optional<ManhattanCue::RotationEstimate>& manhattan_rotation) {
    const SE3 T = with_manhattan_rotation(rotated.T_odom_cam, information, manhattan_rotation,
                                          rotated.window);
    return (rotated.T_odom_cam.inverse() * T).log().norm();
  };
  EXPECT_GT(moved(rotated.manhattan_rotation), 0.05);
  EXPECT_EQ(moved(std::nullopt), 0);
  rotated.manhattan_rotation.manhattan_frame = ManhattanFrameId(8);
  EXPECT_EQ(moved(rotated.manhattan_rotation), 0);
}

}  // namespace manhattan_cue_test
}  // namespace placegraph
