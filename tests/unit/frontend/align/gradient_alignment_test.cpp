#include <gtest/gtest.h>
#include <placegraph/frontend/align/alignment_covariance.h>
#include <placegraph/frontend/align/gradient_alignment.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/support/noise_image.h"

namespace placegraph {
namespace gradient_alignment_test {

using Eigen::Matrix3d;
using Eigen::Vector2d;

PlanarTemplate template_of(const Image& image) {
  return {image, {{20, 16}, {68, 16}, {68, 52}, {20, 52}}, 1, 400};
}

TEST(TemplateGenerators, MoveAGradientAsAStepOfTheWarpDoes) {
  const PlanarTemplate t = template_of(test::noise_image(90, 70, CV_8UC1, 2, 1));
  Matrix3d H, K;
  H << 1.1, 0.05, 7, -0.02, 0.95, -4, 1e-4, -2e-4, 1;
  K << 80, 0, 44, 0, 82, 35, 0, 0, 1;
  const Plane plane{Eigen::Vector3d(0.1, 0.3, 0.9).normalized(), 1.4};
  const Matrix3d to_px = t.px_from_template();
  for (const PlanarWarp& warp :
       {t.homography(H),
        PlanarWarp::rigid_motion(
            K, SE3::exp((Vector6d() << 0.1, 0.05, -0.1, 0.02, 0.05, -0.04).finished()), plane),
        PlanarWarp::planar_motion(K, SE2(0.2, -0.1, 0.1), plane)}) {
    const PlanarWarp::Generators A = template_generators(t, warp);
    Random random(2);
    for (int round = 0; round < 5; ++round) {
      const Vector2d x(random.uniform(-1, 1), random.uniform(-1, 1)),
          gradient(random.normal(), random.normal());
      const Eigen::VectorXd row = A.transpose() * generator_row(x, gradient);
      for (int k = 0; k < warp.dof(); ++k) {
        // The point of the template that is now seen where x was, times the gradient.
        const auto moved = [&](double step) {
          const Matrix3d moving =
              warp.H_cur_ref().inverse() *
              warp.plus(PlanarWarp::Step::Unit(warp.dof(), k) * step).H_cur_ref();
          return gradient.dot((to_px.inverse() * moving * to_px * x.homogeneous()).hnormalized());
        };
        EXPECT_NEAR(row[k], (moved(1e-5) - moved(-1e-5)) / 2e-5, 1e-6 * (1 + std::abs(row[k])));
      }
    }
  }
}

TEST(AlignLevel, StaysAtTheTruthAndReturnsThereFromBeside) {
  const Image image = test::noise_image(90, 70, CV_8UC1, 2.5, 3);
  const PlanarTemplate t = template_of(image);
  const Image pixels = grey_pyramid(image, 1)[0];
  for (const Gradients gradients : {Gradients::kForward, Gradients::kEsm, Gradients::kInverse}) {
    Matrix3d beside = Matrix3d::Identity();
    for (const double off_px : {0.0, 1.0}) {
      beside(0, 2) = off_px, beside(1, 2) = -0.7 * off_px;
      const GradientAlignmentResult end =
          align_level(t, pixels, 0, t.homography(beside), gradients, {});
      EXPECT_LT(t.corner_distance_px(end.warp.H_cur_ref(), Matrix3d::Identity()), 0.05) << off_px;
      EXPECT_EQ(end.visible_share, 1);
    }
  }
}

TEST(CornerSigma, OfAShiftIsTheShift) {
  const PlanarTemplate t = template_of(test::noise_image(90, 70, CV_8UC1, 2, 4));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(8, 8);
  // The first two parameters shift the template, in units of its half side of 24 px.
  covariance(0, 0) = 0.01 * 0.01, covariance(1, 1) = 0.02 * 0.02;
  const PlanarWarp still = t.homography(Matrix3d::Identity());
  EXPECT_NEAR(corner_sigma_px(t, still, covariance), 24 * std::hypot(0.01, 0.02), 1e-9);
  Matrix3d twice = Matrix3d::Identity();
  twice.topLeftCorner<2, 2>() *= 2;
  EXPECT_NEAR(corner_sigma_px(t, t.homography(twice), covariance), 48 * std::hypot(0.01, 0.02),
              1e-9);
}

TEST(CornerSigma, IsPromisedInProportionToTheNoiseAndInfiniteWithoutTexture) {
  const PlanarTemplate t = template_of(test::noise_image(90, 70, CV_8UC1, 2, 5));
  const PlanarWarp still = t.homography(Matrix3d::Identity());
  const double once = promised_corner_sigma_px(t, 0, still, 2);
  EXPECT_NEAR(promised_corner_sigma_px(t, 0, still, 6), 3 * once, 1e-9 * once);
  const PlanarTemplate blank = template_of(Image(70, 90, CV_8UC1, cv::Scalar(80)));
  EXPECT_TRUE(std::isinf(promised_corner_sigma_px(blank, 0, still, 2)));
  Image stripes(70, 90, CV_8UC1);  // they say nothing of a shift along them
  for (int u = 0; u < 90; ++u) stripes.col(u).setTo(100 + 60 * std::sin(0.5 * u));
  EXPECT_TRUE(std::isinf(promised_corner_sigma_px(template_of(stripes), 0, still, 2)));
}

}  // namespace gradient_alignment_test
}  // namespace placegraph
