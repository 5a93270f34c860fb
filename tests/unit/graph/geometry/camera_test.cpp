#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <tests/support/seed.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace placegraph {
namespace camera_test {

Camera pinhole() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 500;
  camera.fy = 510;
  camera.cx = 320;
  camera.cy = 240;
  return camera;
}

/// About the left camera of EuRoC.
Camera radial_tangential() {
  Camera camera = pinhole();
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {-0.283, 0.074, 2e-4, -1.8e-4, 0.01};
  return camera;
}

/// About a fisheye camera of 180 degrees.
Camera equidistant() {
  Camera camera = pinhole();
  camera.fx = 190;
  camera.fy = 191;
  camera.distortion = Distortion::kEquidistant;
  camera.coefficients = {0.0034, 0.0007, -0.0020, 0.0002, 0};
  return camera;
}

std::vector<Camera> cameras() { return {pinhole(), radial_tangential(), equidistant()}; }

TEST(Camera, ProjectsAPointByHand) {
  const auto px = pinhole().project({0.2, -0.1, 2});
  ASSERT_TRUE(px);
  EXPECT_NEAR((*px)[0], 320 + 500 * 0.1, 1e-12);
  EXPECT_NEAR((*px)[1], 240 - 510 * 0.05, 1e-12);
}

TEST(Camera, RadialTangentialDistortsByHand) {
  Camera camera = pinhole();
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {0.1, 0.01, 0.02, 0.03, 0.001};
  // x = 1, y = 0.5: r2 = 1.25, radial = 1 + 0.125 + 0.015625 + 0.001953125 = 1.142578125
  const double x = 1.142578125 + 2 * 0.02 * 0.5 + 0.03 * (1.25 + 2);
  const double y = 0.5 * 1.142578125 + 0.02 * (1.25 + 0.5) + 2 * 0.03 * 0.5;
  const auto px = camera.project({2, 1, 2});
  ASSERT_TRUE(px);
  EXPECT_NEAR((*px)[0], 320 + 500 * x, 1e-10);
  EXPECT_NEAR((*px)[1], 240 + 510 * y, 1e-10);
}

TEST(Camera, EquidistantWithoutCoefficientsMapsAngleToRadius) {
  Camera camera = equidistant();
  camera.coefficients = {};
  const auto px = camera.project({std::tan(1.2), 0, 1});
  ASSERT_TRUE(px);
  EXPECT_NEAR((*px)[0], 320 + 190 * 1.2, 1e-10);
}

TEST(Camera, JacobianAgreesWithFiniteDifferences) {
  Random random = test::seeded_random(7);
  for (const Camera& camera : cameras())
    for (int i = 0; i < 200; ++i) {
      const double z = random.uniform(0.5, 20);
      const double reach = i < 20 ? 1e-7 : 0.6;  // some close to the axis
      const Eigen::Vector3d p(z * random.uniform(-reach, reach), z * random.uniform(-reach, reach),
                              z);
      Eigen::Matrix<double, 2, 3> J, numeric;
      ASSERT_TRUE(camera.project(p, &J));
      const double h = 1e-5 * z;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
        numeric.col(k) = (*camera.project(p + step) - *camera.project(p - step)) / (2 * h);
      }
      // Truncation: focal length / z times (h / z)^2; rounding: 1e-13 px / h.
      EXPECT_LT((J - numeric).cwiseAbs().maxCoeff(), (500 * 1e-9 + 1e-8) / z) << p.transpose();
    }
}

TEST(Camera, JacobianOnTheAxisIsThatOfThePinhole) {
  for (const Camera& camera : cameras()) {
    Eigen::Matrix<double, 2, 3> J, expected;
    ASSERT_TRUE(camera.project({0, 0, 4}, &J));
    expected << camera.fx / 4, 0, 0, 0, camera.fy / 4, 0;
    EXPECT_LT((J - expected).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Camera, UnprojectThenProjectReturnsEveryPixel) {
  for (const Camera& camera : cameras())
    for (int v = 0; v < camera.height; v += 20)
      for (int u = 0; u < camera.width; u += 20) {
        const auto ray = camera.unproject({u, v});
        if (camera.distortion == Distortion::kEquidistant &&
            std::hypot((u - 320) / 190., (v - 240) / 191.) > 1.5)
          continue;  // beyond a right angle, where there is no ray of z = 1
        ASSERT_TRUE(ray) << u << " " << v;
        EXPECT_EQ((*ray)[2], 1);
        const auto px = camera.project(*ray);
        ASSERT_TRUE(px);
        // 1e-10 in normalized coordinates.
        EXPECT_LT((*px - Eigen::Vector2d(u, v)).norm(), 1e-10 * 510) << u << " " << v;
      }
}

TEST(Camera, ProjectThenUnprojectReturnsTheRay) {
  Random random = test::seeded_random(8);
  for (const Camera& camera : cameras())
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d ray(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 1);
      const auto back = camera.unproject(*camera.project(random.uniform(0.1, 50) * ray));
      ASSERT_TRUE(back);
      EXPECT_LT((*back - ray).norm(), 1e-9);
    }
}

TEST(Camera, PointsBehindOrInTheImagePlaneHaveNoPixel) {
  for (const Camera& camera : cameras()) {
    EXPECT_FALSE(camera.project({0, 0, -1}));
    EXPECT_FALSE(camera.project({1, 1, 0}));
    EXPECT_FALSE(camera.project({0, 0, std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_FALSE(camera.project({std::numeric_limits<double>::infinity(), 0, 1}));
  }
}

TEST(Camera, RadialDistortionEndsWhereItStopsGrowing) {
  Camera camera = pinhole();
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {-0.3, 0, 0, 0, 0};
  // r (1 - 0.3 r^2) grows up to r = 1 / sqrt(0.9); what folds back beyond may not be seen.
  const double limit = 1 / std::sqrt(0.9);
  EXPECT_TRUE(camera.project({limit * 0.999, 0, 1}));
  EXPECT_FALSE(camera.project({limit * 1.001, 0, 1}));
  EXPECT_FALSE(camera.project({0, -5, 1}));
  // Nor has a pixel further out than the fold a ray.
  const double farthest = limit * (1 - 0.3 * limit * limit);
  EXPECT_TRUE(camera.unproject({320 + 500 * farthest * 0.999, 240}));
  EXPECT_FALSE(camera.unproject({320 + 500 * farthest * 1.001, 240}));
}

TEST(Camera, RadialDistortionThatGrowsAgainIsStillRefusedBeyondItsFirstFold) {
  Camera camera = pinhole();
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {-0.6, 0.15, 0, 0, 0};
  // Derivative 1 - 1.8 x + 0.75 x^2, x = r^2: roots 0.875 and 1.525.
  const double first = (1.8 - std::sqrt(1.8 * 1.8 - 3)) / 1.5;
  EXPECT_TRUE(camera.project({std::sqrt(first) * 0.999, 0, 1}));
  EXPECT_FALSE(camera.project({std::sqrt(first) * 1.001, 0, 1}));
  EXPECT_FALSE(camera.project({2, 0, 1}));  // the derivative is positive again here
}

TEST(Camera, EquidistantEndsAtItsMonotonicAngle) {
  Camera camera = equidistant();
  camera.coefficients = {-0.5, 0, 0, 0, 0};
  // a (1 - 0.5 a^2) grows up to a = sqrt(2 / 3).
  const double limit = std::sqrt(2. / 3);
  EXPECT_TRUE(camera.project({std::tan(limit * 0.999), 0, 1}));
  EXPECT_FALSE(camera.project({std::tan(limit * 1.001), 0, 1}));
  EXPECT_FALSE(camera.unproject({320 + 190 * limit * (2. / 3) * 1.001, 240}));
}

TEST(Camera, EquidistantPixelBeyondARightAngleHasNoRay) {
  Camera camera = equidistant();
  camera.coefficients = {};
  EXPECT_TRUE(camera.unproject({320 + 190 * 1.57, 240}));
  EXPECT_FALSE(camera.unproject({320 + 190 * 1.58, 240}));
}

TEST(Camera, ContainsCountsPixelCentresAndBorder) {
  const Camera camera = pinhole();
  EXPECT_TRUE(camera.contains({0, 0}));
  EXPECT_TRUE(camera.contains({639, 479}));
  EXPECT_FALSE(camera.contains({639.1, 479}));
  EXPECT_FALSE(camera.contains({-0.1, 5}));
  EXPECT_FALSE(camera.contains({4, 100}, 5));
  EXPECT_FALSE(camera.contains({std::numeric_limits<double>::quiet_NaN(), 5}));
}

TEST(Camera, MatrixHoldsTheIntrinsics) {
  Eigen::Matrix3d K;
  K << 500, 0, 320, 0, 510, 240, 0, 0, 1;
  EXPECT_EQ(pinhole().K(), K);
}

TEST(Camera, CheckNamesTheFieldThatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(Camera&)>>> mistakes = {
      {"camera.width", [](Camera& c) { c.width = 0; }},
      {"camera.height", [](Camera& c) { c.height = -3; }},
      {"camera.fx", [](Camera& c) { c.fx = 0; }},
      {"camera.fy", [&](Camera& c) { c.fy = nan; }},
      {"camera.cx", [&](Camera& c) { c.cx = nan; }},
      {"camera.cy", [&](Camera& c) { c.cy = -nan; }},
      {"camera.coefficients", [&](Camera& c) { c.coefficients[3] = nan; }}};
  EXPECT_NO_THROW(pinhole().check());
  for (const auto& [field, spoil] : mistakes) {
    Camera camera = pinhole();
    spoil(camera);
    try {
      camera.check();
      ADD_FAILURE() << field << " passed";
    } catch (const ArgumentError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(field + ":"));
    }
  }
}

TEST(Calibration, CheckNamesTheFieldThatIsWrong) {
  Calibration good;
  good.camera = pinhole();
  good.baseline_m = 0.5;
  good.camera_height_m = 1.65;
  good.depth = DepthCamera{pinhole(), SE3(), 0.005};
  EXPECT_NO_THROW(good.check());
  const auto message = [&](const std::function<void(Calibration&)>& spoil) -> std::string {
    Calibration calibration = good;
    spoil(calibration);
    try {
      calibration.check();
    } catch (const ArgumentError& error) {
      return error.what();
    }
    return "passed";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message([](auto& c) { c.camera.fx = 0; }), HasSubstr("camera.fx"));
  EXPECT_THAT(message([](auto& c) { c.baseline_m = -1; }), HasSubstr("baseline_m"));
  EXPECT_THAT(message([](auto& c) { c.camera_height_m = 0; }), HasSubstr("camera_height_m"));
  EXPECT_THAT(message([](auto& c) { c.depth->sigma_at_1m = 0; }), HasSubstr("sigma_at_1m"));
  EXPECT_THAT(message([](auto& c) { c.depth->camera.width = 0; }), HasSubstr("camera.width"));
  EXPECT_THAT(
      message([](auto& c) { c.depth->T_cam_depth = SE3(SO3(), Eigen::Vector3d::Constant(NAN)); }),
      HasSubstr("T_cam_depth"));
}

}  // namespace camera_test
}  // namespace placegraph
