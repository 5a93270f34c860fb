#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/render/height_surface.h>

#include <limits>

namespace placegraph::synthetic {
namespace height_surface_test {

/// A pass along x = `x` at height `y`, with samples beside it that keep the road level sideways.
std::vector<Eigen::Vector3d> pass_samples(double x, double y) {
  std::vector<Eigen::Vector3d> samples;
  for (int z = 0; z <= 100; ++z) {
    for (const double side : {-7.0, 0.0, 7.0}) samples.emplace_back(x + side, y, z);
  }
  return samples;
}

TEST(HeightSurface, ReproducesASlopeThatItsSamplesLieOn) {
  std::vector<Eigen::Vector3d> samples;
  for (int i = 0; i < 60; ++i) {
    const double x = i % 10 * 5.0, z = i / 10 * 8.0;
    samples.emplace_back(x, 3 + 0.05 * x - 0.02 * z, z);
  }
  const HeightSurface surface = HeightSurface::fit(samples, 4, 10, 20);
  // A plane costs the thin plate nothing; only the pull to level (1e-6) moves it.
  EXPECT_NEAR(surface.height(22, 17), 3 + 0.05 * 22 - 0.02 * 17, 1e-3);
  const Eigen::Vector3d expected = Eigen::Vector3d(0.05, -1, -0.02).normalized();
  EXPECT_LT((surface.normal(22, 17) - expected).norm(), 1e-3);
}

TEST(HeightSurface, PassesThatContradictEachOtherMeetHalfWay) {
  std::vector<Eigen::Vector3d> samples = pass_samples(0, 0.0);
  const std::vector<Eigen::Vector3d> second = pass_samples(0.1, 2.0);
  samples.insert(samples.end(), second.begin(), second.end());
  const HeightSurface surface = HeightSurface::fit(samples, 4, 100, 20);
  EXPECT_NEAR(surface.height(0.05, 50), 1.0, 0.05);
  EXPECT_NEAR(surface.height(0, 50), surface.height(0.1, 50), 0.05);  // and no cliff between
}

TEST(HeightSurface, RefusesSamplesThatAreMissingOrNotFinite) {
  EXPECT_THROW(HeightSurface::fit({}, 4, 10, 20), ArgumentError);
  EXPECT_THROW(HeightSurface::fit({{0, std::numeric_limits<double>::quiet_NaN(), 0}}, 4, 10, 20),
               ArgumentError);
}

TEST(GroundMesh, IsTheSurfaceAtVerticesAndContinuousBetween) {
  const GroundMesh mesh(HeightSurface::from_function(
      {-50, -50}, {50, 50}, 5, [](double x, double z) { return 0.01 * x * x - 0.02 * x * z; }));
  EXPECT_DOUBLE_EQ(mesh.height(4, -6), mesh.surface.height(4, -6));
  const double e = 1e-9;
  EXPECT_NEAR(mesh.height(4.7 + e, 6.7 - e), mesh.height(4.7 - e, 6.7 + e), 1e-8);  // diagonal
  EXPECT_NEAR(mesh.height(6 - e, 5.3), mesh.height(6 + e, 5.3), 1e-8);              // cell border
  // Between vertices it is linear: half way along an edge, the mean of the ends.
  EXPECT_NEAR(mesh.height(5, 6), 0.5 * (mesh.height(4, 6) + mesh.height(6, 6)), 1e-12);
}

}  // namespace height_surface_test
}  // namespace placegraph::synthetic
