#include <gtest/gtest.h>
#include <placegraph/io/synthetic/defects/vehicle.h>

#include <cmath>

namespace placegraph::synthetic {
namespace vehicle_test {

constexpr double kHeight_m = 0.02;

GroundMesh road(double rms_m, std::uint64_t seed = 3) {
  return GroundMesh(HeightSurface::from_function({-500, -500}, {500, 500}, 50,
                                                 [](double, double) { return 0.0; }),
                    Undulation(rms_m, seed));
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(Undulation, HasTheHeightThatItStates) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Undulation undulation(kHeight_m, seed);
    const GroundMesh mesh = road(kHeight_m, seed);
    std::vector<double> waves, rendered;
    for (double x = -400; x < 400; x += 7.3)
      for (double z = -400; z < 400; z += 7.7) {
        waves.push_back(undulation.height(x, z));
        rendered.push_back(mesh.height(x, z));
      }
    EXPECT_NEAR(root_mean_square(waves), kHeight_m, 0.05 * kHeight_m);
    // The mesh of 1 m rounds the shortest waves.
    EXPECT_NEAR(root_mean_square(rendered), kHeight_m, 0.08 * kHeight_m);
  }
}

TEST(Undulation, OfZeroLeavesTheGroundAsItIs) {
  const GroundMesh level = road(0);
  EXPECT_TRUE(level.undulation.empty());
  EXPECT_EQ(level.cell_m, 2);
  EXPECT_EQ(level.height(12.3, 45.6), 0);
  const SE3 pose(SO3::exp({0.01, 0.4, 0.02}), Eigen::Vector3d(3, -1.65, 4));
  EXPECT_EQ(on_undulation(level, pose).matrix(), pose.matrix());
}

TEST(Undulation, LiftsAndTiltsACarAsItsWheelsDo) {
  const GroundMesh mesh = road(kHeight_m);
  std::vector<double> lift, rest, pitch;
  for (double s = 0; s < 300; s += 1.1) {
    const SE3 level(SO3::exp({0, 0.5, 0}),
                    Eigen::Vector3d(s * std::sin(0.5), -1.65, s * std::cos(0.5)));
    const SE3 found = on_undulation(mesh, level);
    const Eigen::Vector3d p = found.translation();
    EXPECT_EQ(p[0], level.translation()[0]);
    lift.push_back(p[1] + 1.65);
    rest.push_back(p[1] + 1.65 - mesh.height(p[0], p[2]));
    // The height of a point 1.35 m ahead of the camera and as high above the mean of the wheels.
    const Eigen::Vector3d nose = found * Eigen::Vector3d(0, 1.65, 0.5 * kWheelbase_m);
    const Eigen::Vector2d ahead(std::sin(0.5), std::cos(0.5)), right(ahead[1], -ahead[0]);
    double front = 0;
    for (const double side : {-0.8, 0.8}) {
      const Eigen::Vector2d wheel = Eigen::Vector2d(p[0], p[2]) + 1.35 * ahead + side * right;
      front += 0.5 * mesh.height(wheel[0], wheel[1]);
    }
    double back = 0;
    for (const double side : {-0.8, 0.8}) {
      const Eigen::Vector2d wheel = Eigen::Vector2d(p[0], p[2]) - 1.35 * ahead + side * right;
      back += 0.5 * mesh.height(wheel[0], wheel[1]);
    }
    EXPECT_NEAR(nose[1], front, 5e-4);
    pitch.push_back((front - back) / kWheelbase_m);
    EXPECT_NEAR(-(level.rotation().inverse() * found.rotation()).log()[0], pitch.back(), 1e-9);
  }
  EXPECT_GT(root_mean_square(pitch), 0.004);
  // A car averages its wheels: it moves a little less than the road, and the camera's height above
  // the road changes by some millimetres.
  EXPECT_LT(root_mean_square(lift), 1.1 * kHeight_m);
  EXPECT_GT(root_mean_square(lift), 0.7 * kHeight_m);
  EXPECT_GT(root_mean_square(rest), 0.001);
  EXPECT_LT(root_mean_square(rest), 0.4 * kHeight_m);
}

}  // namespace vehicle_test
}  // namespace placegraph::synthetic
