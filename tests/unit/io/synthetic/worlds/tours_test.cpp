#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/tours.h>

namespace placegraph::synthetic {
namespace tours_test {

TEST(SmoothPath, RoundsACornerAndKeepsTheEnds) {
  const auto path = smooth_path({{0, 0}, {0, 50}, {50, 50}}, 0.25, 6);
  EXPECT_LT((path.front() - Eigen::Vector2d(0, 0)).norm(), 1e-9);
  EXPECT_LT((path.back() - Eigen::Vector2d(50, 50)).norm(), 0.3);  // the last step is cut
  double sharpest = 0, nearest = 1e9;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d a = path[i] - path[i - 1], b = path[i + 1] - path[i];
    sharpest = std::max(sharpest, std::abs(a[0] * b[1] - a[1] * b[0]) / (a.norm() * b.norm()));
    nearest = std::min(nearest, (path[i] - Eigen::Vector2d(0, 50)).norm());
  }
  // Direction follows the integral of three boxes of 6.25 m, steepest at 0.75 / 6.25 a metre; where
  // both components are one half that is a curvature of 0.12 / 0.5 / 0.71 = 0.34 / m.
  EXPECT_LT(sharpest, 0.25 * 0.34 * 1.15);
  EXPECT_GT(nearest, 1);
}

TEST(DrivePositions, SlowsDownInBendsAndKeepsToItsLimits) {
  const auto path = smooth_path({{0, 0}, {0, 80}, {80, 80}}, 0.25, 6);
  const SpeedLimits limits;
  const auto s = drive_positions(path, 0.25, limits, 0.1);
  double fastest = 0, slowest = 1e9, braking = 0;
  for (std::size_t i = 2; i < s.size(); ++i) {
    const double speed = (s[i] - s[i - 1]) / 0.1;
    fastest = std::max(fastest, speed);
    slowest = std::min(slowest, speed);
    braking = std::max(braking, std::abs(s[i] - 2 * s[i - 1] + s[i - 2]) / 0.01);
  }
  EXPECT_NEAR(fastest, limits.cruise_mps, 0.01);
  EXPECT_LT(slowest, 6);
  EXPECT_GT(slowest, 3);
  EXPECT_LT(braking, 1.3 * limits.forward_mps2);  // smoothing moves the profile a little
}

TEST(CameraAxes, AreARotationThatLooksForwardAndDown) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.05, -1, 0.1).normalized();
  const Eigen::Matrix3d R = camera_axes({0.6, 0, 0.8}, up, 0.01, -0.02, 0.03);
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1, 1e-12);
  EXPECT_NEAR(R.col(2).dot(up), 0.01, 1e-3);  // pitch: the nose is up
  EXPECT_NEAR(R.col(0).dot(up), 0.03, 1e-3);  // roll: the right side is up
  EXPECT_LT(R.col(1).dot(up), -0.99);
}

}  // namespace tours_test
}  // namespace placegraph::synthetic
