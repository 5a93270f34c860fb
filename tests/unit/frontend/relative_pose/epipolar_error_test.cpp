#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace epipolar_error_test {

using namespace test;

TEST(EpipolarError, OfASidewaysMotionIsTheDifferenceOfHeightsOverRootTwo) {
  Camera camera = pinhole(640, 480, 500);
  camera.fy = camera.fx;
  const EpipolarError error(camera, pose({0, 0, 0}, {3, 0, 0}));
  // Equal heights meet; a height of 2 px more is missed by 2 / sqrt 2.
  EXPECT_NEAR(error({0.1, 0.2, 1}, {0.0, 0.2, 1}), 0, 1e-12);
  EXPECT_NEAR(std::abs(error({0.1, 0.2, 1}, {0.0, 0.204, 1})), 2 / std::sqrt(2.0), 1e-9);
}

TEST(EpipolarError, HasTheDerivativeOfFiniteDifferences) {
  const Camera camera = pinhole(640, 480, 500);
  const SE3 T = pose({0.1, -0.2, 0.05}, {0.6, -0.3, 0.8});
  const Eigen::Vector3d a(0.2, -0.1, 1), b(0.15, 0.05, 1);
  Eigen::Matrix<double, 1, 6> J;
  (void)EpipolarError(camera, T)(a, b, &J);
  constexpr double h = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = h * Vector6d::Unit(k);
    const double difference =
        (EpipolarError(camera, T.plus(step))(a, b) - EpipolarError(camera, T.plus(-step))(a, b)) /
        (2 * h);
    EXPECT_NEAR(J[k], difference, 1e-5 * (1 + std::abs(difference))) << k;
  }
  // Along the translation nothing changes.
  EXPECT_NEAR(J.head<3>() * (T.rotation().inverse() * T.translation()), 0, 1e-9);
}

TEST(TwoViewParallax, CountsWhereRaysMeetAndHowFarTheyMove) {
  Camera camera = pinhole(640, 480, 500);
  camera.fy = camera.fx;
  const SE3 right = pose({0, 0, 0}, {1, 0, 0});
  // Points at depths 5 and 10: 100 and 50 px.
  const std::vector<Eigen::Vector3d> ref{{0, 0, 1}, {0.1, 0, 1}, {0.2, 0, 1}};
  const std::vector<Eigen::Vector3d> cur{{-0.2, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const auto parallax = two_view_parallax(camera, right, ref, cur, {0, 1, 2});
  EXPECT_EQ(parallax.ahead, 3);
  EXPECT_EQ(parallax.behind, 0);
  EXPECT_NEAR(parallax.median_px, 100, 1e-9);
  const auto opposite = two_view_parallax(camera, right.inverse(), ref, cur, {0, 1});
  EXPECT_EQ(opposite.behind, 2);
}

TEST(RaysOf, HaveDepthOne) {
  const Camera camera = pinhole(640, 480, 500);
  const auto rays = rays_of(camera, {{camera.cx, camera.cy}, {camera.cx + 500, camera.cy}});
  EXPECT_TRUE(rays[0].isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(rays[1].isApprox(Eigen::Vector3d(1, 0, 1)));
}

}  // namespace epipolar_error_test
}  // namespace placegraph
