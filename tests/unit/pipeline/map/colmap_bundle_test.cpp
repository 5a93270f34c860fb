#include <placegraph/pipeline/map/colmap_bundle.h>

#include "tests/support/scenes/colmap_scene.h"

namespace placegraph {
namespace colmap_bundle_test {

constexpr int kViews = 5, kPoints = 60;

/// A model with exact observations of a camera, and noise in poses and points.
class ColmapBundleTest : public testing::Test {
 protected:
  ColmapModel disturbed(const Camera& camera) {
    scene = test::make_scene(test::pinhole(640, 480, 500), test::sideways(kViews), kPoints, random);
    ColmapModel model = test::disturbed_colmap_model(scene, camera, random);
    for (ColmapModel::Point& point : model.points) point.p_world *= 1 + random.normal(0, 0.01);
    return model;
  }
  /// The largest distance between a point of a model, as its first camera sees it, and the true
  /// one, as a share of its depth; the model has a scale of its own.
  double error_of_shape(const ColmapModel& model) const {
    const SE3 T_first_last =
                  model.images.front().T_world_cam.inverse() * model.images.back().T_world_cam,
              true_motion = scene.T_ref_cam.front().inverse() * scene.T_ref_cam.back();
    const double scale = T_first_last.translation().norm() / true_motion.translation().norm();
    double most = 0;
    for (std::size_t k = 0; k < kPoints; ++k) {
      const Eigen::Vector3d p = scene.T_ref_cam.front().inverse() * scene.points_ref[k];
      const Eigen::Vector3d q =
          model.images.front().T_world_cam.inverse() * model.points[k].p_world / scale;
      most = std::max(most, (q - p).norm() / p.z());
    }
    return most;
  }
  test::PointScene scene;  ///< what disturbed() was made of
  Random random{7};
};

TEST_F(ColmapBundleTest, FindsWhatExplainsExactObservations) {
  Camera camera = test::pinhole(640, 480, 500);
  for (const Distortion lens :
       {Distortion::kNone, Distortion::kRadialTangential, Distortion::kEquidistant}) {
    camera.distortion = lens;
    if (lens != Distortion::kNone) camera.coefficients = {-0.1, 0.02, 0.001, -0.001};
    const ColmapModel start = disturbed(camera);
    const ColmapBundleReport report = adjust_colmap(start, {});
    ASSERT_TRUE(report.outcome) << report.outcome.reason;
    EXPECT_GT(report.error_before_px, 1);  // 0.004 rad are 2 px
    EXPECT_LT(report.error_px, 1e-3);
    EXPECT_GT(report.cost_initial, 100);
    EXPECT_LT(report.cost_final, 1e-4);
    EXPECT_GT(error_of_shape(start), 0.01);  // the noise of a point
    EXPECT_LT(error_of_shape(report.model), 1e-3);
    EXPECT_GT(report.observations, std::size_t{kViews * kPoints / 2});
    EXPECT_EQ(report.model.images[3].name, "3.png");
    EXPECT_EQ(report.model.camera.distortion, lens);
    for (const ColmapModel::Point& point : report.model.points)
      EXPECT_TRUE(point.error_px >= 0 && point.error_px < 1e-2) << point.error_px;
  }
}

TEST_F(ColmapBundleTest, AKernelHoldsAFalseObservation) {
  ColmapModel start = disturbed(test::pinhole(640, 480, 500));
  start.images[1].observations[4].px[0] += 40;
  BundleOptions options;
  const double plain = adjust_colmap(start, options).cost_final;
  options.kernel = {RobustKernel::Kind::kCauchy, 1};
  const ColmapBundleReport robust = adjust_colmap(start, options);
  EXPECT_GT(plain, 100);
  EXPECT_LT(robust.cost_final, 10);
}

TEST_F(ColmapBundleTest, NeedsObservations) {
  ColmapModel model = disturbed(test::pinhole(640, 480, 500));
  for (ColmapModel::Image& image : model.images) image.observations.clear();
  const ColmapBundleReport report = adjust_colmap(model, {});
  EXPECT_EQ(report.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(report.model.images.size(), std::size_t{kViews});
}

}  // namespace colmap_bundle_test
}  // namespace placegraph
