#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>

#include "tests/support/scenes/corridor_view.h"

namespace placegraph {
namespace {

/// A keyframe that sees the corridor, or other edges.
struct Keyframe0 {
  test::CorridorView corridor{true};
  SlidingWindow window{SlidingWindowOptions{}, corridor.camera};
  ManhattanCue cue{{}, corridor.camera, 1, {}};

  Keyframe0() { window.add_keyframe(0, SE3()); }
  void see(const std::vector<LineSegment>& segments) {
    const Image grey(corridor.camera.height, corridor.camera.width, CV_8UC1, cv::Scalar(128));
    cue.observe(0, grey, segments, window);
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
  const GroundSight ground = keyframe.cue.ground(keyframe.lane(2));
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
  const GroundSight narrow = keyframe.cue.ground(keyframe.lane(0.5));
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

}  // namespace
}  // namespace placegraph
