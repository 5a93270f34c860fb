#include <gtest/gtest.h>
#include <placegraph/io/synthetic/defects/camera_motion.h>

#include <cmath>

namespace placegraph::synthetic {
namespace camera_motion_test {

/// A camera that swings and turns within a second.
SE3 swing(double t) {
  return SE3(SO3::exp({0.1 * std::sin(3 * t), 0.5 * t + 0.1 * std::cos(2 * t), 0.05 * t * t}),
             Eigen::Vector3d(std::sin(2 * t), 0.2 * std::cos(3 * t), 4 * t));
}

struct Recorded {
  std::vector<double> time_s;
  std::vector<SE3> poses;
};

Recorded record(double interval_s) {
  Recorded out;
  for (int i = 0; i < 60; ++i) {
    out.time_s.push_back(interval_s * i + 0.1 * interval_s * (i % 3));  // not quite regular
    out.poses.push_back(swing(out.time_s.back()));
  }
  return out;
}

double largest_error(double interval_s) {
  const Recorded recorded = record(interval_s);
  double worst = 0;
  for (double t = 5 * interval_s; t < 50 * interval_s; t += 0.17 * interval_s) {
    const SE3 found = pose_at(recorded.time_s, recorded.poses, t);
    worst = std::max(worst, (swing(t).inverse() * found).log().norm());
  }
  return worst;
}

TEST(CameraMotion, IsExactAtThePoses) {
  const Recorded recorded = record(0.1);
  for (const std::size_t i : {0U, 1U, 30U, 59U}) {
    const SE3 found = pose_at(recorded.time_s, recorded.poses, recorded.time_s[i]);
    EXPECT_LT((found.matrix() - recorded.poses[i].matrix()).norm(), 1e-12);
  }
}

TEST(CameraMotion, FollowsASmoothMotionWithAnErrorOfHigherOrder) {
  const double coarse = largest_error(0.1), fine = largest_error(0.05);
  EXPECT_LT(coarse, 1e-3);      // straight lines would be wrong by 4 m/s^2 (0.1 s)^2 / 8 = 5e-3
  EXPECT_LT(fine, coarse / 6);  // of third order, also where the times are irregular
}

TEST(CameraMotion, GoesOnWithTheSameVelocityBeyondTheEnds) {
  std::vector<double> time_s;
  std::vector<SE3> poses;
  for (int i = 0; i < 5; ++i) {
    time_s.push_back(0.1 * i);
    poses.emplace_back(SO3::exp({0, 0.02 * i, 0}), Eigen::Vector3d(0.3 * i, 0, 1));
  }
  const SE3 before = pose_at(time_s, poses, -0.05), after = pose_at(time_s, poses, 0.45);
  EXPECT_NEAR(before.translation()[0], -0.15, 1e-12);
  EXPECT_NEAR(before.rotation().log()[1], -0.01, 1e-12);
  EXPECT_NEAR(after.translation()[0], 1.35, 1e-12);
  EXPECT_NEAR(after.rotation().log()[1], 0.09, 1e-12);
}

TEST(CameraMotion, OfOnePoseStandsStill) {
  const SE3 only(SO3(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(pose_at({5}, {only}, 7).translation()[2], 3);
}

}  // namespace camera_motion_test
}  // namespace placegraph::synthetic
