#include <gtest/gtest.h>
#include <placegraph/frontend/scene/horizon.h>
#include <placegraph/frontend/scene/popup.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace popup_test {

/// 100 x 80 pixels, the horizon of a level camera in row 39.5.
GroundView small_view() {
  GroundView view;
  view.camera = {100, 80, 80, 80, 49.5, 39.5, Distortion::kNone, {}};
  view.height_m = 2;
  return view;
}

TEST(GroundView, KnowsTheGroundOfAPixelByHand) {
  const GroundView view = small_view();
  // 16 rows under the horizon: 2 m * 80 / 16 = 10 m ahead.
  const auto point = ground_point(view, {49.5, 55.5});
  ASSERT_TRUE(point);
  EXPECT_NEAR((*point - Eigen::Vector3d(0, 2, 10)).norm(), 0, 1e-9);
  EXPECT_FALSE(ground_point(view, {20, 39}));
  EXPECT_NEAR((ground_place(view, 3, 10) - Eigen::Vector3d(3, 2, 10)).norm(), 0, 1e-9);
}

TEST(PopUp, StandsAWallOnTheGroundItMeetsAndPutsABoxBehindOrBeforeIt) {
  const GroundView view = small_view();
  Image surfaces(80, 100, CV_8UC1, cv::Scalar(static_cast<int>(Surface::kSky)));
  surfaces.rowRange(40, 80).setTo(static_cast<int>(Surface::kGround));
  surfaces(cv::Rect(30, 20, 40, 36))
      .setTo(static_cast<int>(Surface::kVertical));  // its foot: row 55.5, 10 m
  const PopUp popup = pop_up(surfaces, view);
  EXPECT_TRUE(std::isinf(popup.distance.at<float>(5, 5)));
  const auto point = popped_point(popup, view, 50, 25);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->z(), 10, 0.1);
  EXPECT_FALSE(popped_point(popup, view, 5, 5));

  const Image bgr(80, 100, CV_8UC3, cv::Scalar::all(10));
  Image mask;
  (void)overlay_box(bgr, popup, view, {0, 20, 1, 0.2, 3}, &mask);
  EXPECT_EQ(cv::countNonZero(mask == 255), 0);  // 20 m away: behind the wall
  EXPECT_GT(cv::countNonZero(mask == 128), 0);
  const Image drawn = overlay_box(bgr, popup, view, {0, 6, 1, 0.2, 3}, &mask);
  EXPECT_EQ(cv::countNonZero(mask == 128), 0);
  EXPECT_GT(cv::countNonZero(mask == 255), 0);
  EXPECT_GT(cv::norm(drawn, bgr, cv::NORM_INF), 0);
  EXPECT_THROW((void)overlay_box(bgr, popup, view, {0, -5, 1, 1, 1}), ArgumentError);
  EXPECT_THROW((void)pop_up(Image(8, 8, CV_8UC1), view), ArgumentError);
}

TEST(Horizon, IsWhereLevelAndUprightEdgesSay) {
  // Edges of a street seen by a camera that looks 4 degrees down and leans 2 degrees.
  const Camera camera{640, 480, 500, 500, 319.5, 239.5, Distortion::kNone, {}};
  const Eigen::Matrix3d R_cam_world = (Eigen::AngleAxisd(4 * kRadPerDeg, Eigen::Vector3d::UnitX()) *
                                       Eigen::AngleAxisd(2 * kRadPerDeg, Eigen::Vector3d::UnitZ()))
                                          .toRotationMatrix();
  std::vector<LineSegment> segments;
  Random random(4);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 15; ++i) {
      const Eigen::Vector3d begin(random.uniform(-6, 6), random.uniform(-3, 2),
                                  random.uniform(8, 16));
      const auto a = camera.project(R_cam_world * begin);
      const auto b = camera.project(R_cam_world * (begin + 2 * Eigen::Vector3d::Unit(axis)));
      if (!a || !b || (*a - *b).norm() < 15) continue;
      const auto noise = [&] {
        return Eigen::Vector2d(random.normal(0, 0.2), random.normal(0, 0.2));
      };
      segments.push_back({*a + noise(), *b + noise()});
    }
  const Horizon horizon = estimate_horizon(segments, camera, {}, random);
  ASSERT_TRUE(horizon.outcome) << horizon.outcome.reason;
  const double off =
      std::acos(std::min(1.0, horizon.down.dot(R_cam_world * Eigen::Vector3d::UnitY())));
  EXPECT_LT(off / kRadPerDeg, 0.5);  // segments of 60 px with ends off by 0.2: 0.3 degrees each
  EXPECT_GE(horizon.directions, 2);

  const Horizon none = estimate_horizon({}, camera, {}, random);
  EXPECT_EQ(none.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(none.down, Eigen::Vector3d::UnitY());
}

}  // namespace popup_test
}  // namespace placegraph
