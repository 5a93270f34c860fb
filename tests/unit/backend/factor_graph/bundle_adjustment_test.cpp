#include <gtest/gtest.h>
#include <placegraph/backend/factor_graph/bundle_adjustment.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace bundle_adjustment_test {

/// Cameras around a cloud of points, all seen by all.
Bundle make_bundle(Random& random) {
  Bundle bundle;
  for (int i = 0; i < 5; ++i) {
    const SE3 T_world_cam(SO3::exp({0.05 * i, 0.2 * i - 0.4, 0.03}),
                          Eigen::Vector3d(4.0 * (0.2 * i - 0.4), 0.2 * i, -8));
    bundle.cameras.push_back({T_world_cam, 500.0 + 5 * i, -0.05, 0.01});
  }
  for (int i = 0; i < 60; ++i)
    bundle.points.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
  for (int camera = 0; camera < 5; ++camera)
    for (int point = 0; point < 60; ++point) {
      const BundleCamera& c = bundle.cameras[static_cast<std::size_t>(camera)];
      const Eigen::Vector3d p =
          c.T_world_cam.inverse() * bundle.points[static_cast<std::size_t>(point)];
      const Eigen::Vector2d q = p.head<2>() / p.z();
      const double s = q.squaredNorm();
      bundle.observations.push_back(
          {camera, point, c.focal_px * (1 + c.k1 * s + c.k2 * s * s) * q});
    }
  return bundle;
}

Bundle disturbed(Bundle bundle, Random& random) {
  for (BundleCamera& camera : bundle.cameras) {
    camera.T_world_cam = camera.T_world_cam * test::random_motion(random, 0.05, 0.01);
    camera.focal_px *= 1.02;
    camera.k1 = camera.k2 = 0;
  }
  for (Eigen::Vector3d& p : bundle.points)
    p += 0.05 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return bundle;
}

TEST(BundleAdjustment, ExplainsExactObservationsWithoutResidual) {
  Random random(1);
  const Bundle truth = make_bundle(random);
  BundleOptions options;
  options.relative_decrease = 1e-15;
  const BundleReport report = adjust_bundle(disturbed(truth, random), options);
  ASSERT_TRUE(report.outcome) << report.outcome.reason;
  EXPECT_GT(report.cost_initial, 100);
  EXPECT_LT(report.cost_final, 1e-10);
  EXPECT_LT(report.rms_px, 1e-6);
  // Up to a similarity: distances in proportion.
  const auto ratio = [&](std::size_t a, std::size_t b) {
    return (report.bundle.points[a] - report.bundle.points[b]).norm() /
           (truth.points[a] - truth.points[b]).norm();
  };
  EXPECT_NEAR(ratio(0, 1), ratio(2, 3), 1e-5);
  EXPECT_NEAR(report.bundle.cameras[3].focal_px, truth.cameras[3].focal_px, 0.01);
}

TEST(BundleAdjustment, LetsAKernelSilenceOutliers) {
  Random random(2);
  Bundle truth = make_bundle(random);
  for (std::size_t i = 0; i < truth.observations.size(); i += 29)
    truth.observations[i].px += Eigen::Vector2d(60, -40);
  const Bundle start = disturbed(truth, random);
  BundleOptions options;
  const auto error_px = [&] {
    return std::abs(adjust_bundle(start, options).bundle.cameras[2].focal_px -
                    truth.cameras[2].focal_px);
  };
  const double plain = error_px();
  options.kernel = {RobustKernel::Kind::kCauchy, 1};
  EXPECT_LT(error_px(), 0.1 * plain);
}

TEST(BundleAdjustment, TellsWhyThereIsNoAnswer) {
  Random random(3);
  Bundle bundle = disturbed(make_bundle(random), random);
  BundleOptions options;
  options.max_iterations = 1;
  options.relative_decrease = 0;
  EXPECT_EQ(adjust_bundle(bundle, options).outcome.code, Outcome::Code::kNotConverged);
  bundle.observations.clear();
  EXPECT_EQ(adjust_bundle(bundle, {}).outcome.code, Outcome::Code::kTooFewData);
  bundle.observations.push_back({9, 0, {0, 0}});
  EXPECT_THROW((void)adjust_bundle(bundle, {}), ArgumentError);
  options.max_iterations = 0;
  EXPECT_THROW((void)adjust_bundle({}, options), ArgumentError);
}

}  // namespace bundle_adjustment_test
}  // namespace placegraph
