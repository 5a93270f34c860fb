#include <gtest/gtest.h>
#include <placegraph/pipeline/dense/depth_cleaning.h>

#include "tests/unit/pipeline/dense/rendered_depth.h"

namespace placegraph {
namespace depth_cleaning_test {

using test::rendered_depth;

/// A plane at depth 1 in columns below 80, at depth 2 from there on.
KeyframeDepth step() {
  KeyframeDepth depth = rendered_depth(
      SE3(), 0.001, [](const auto&, const auto& ray) { return ray[0] < 0 ? 1.0 : 2.0; });
  return depth;
}

TEST(LimitUncertainty, KeepsDepthsUpToTheShare) {
  KeyframeDepth depth = step();
  depth.sigma_inverse.setTo(0.015);
  limit_uncertainty(depth, 0.02);  // 1.5 % at a depth of 1, 3 % at 2
  EXPECT_EQ(depth.depth.at<float>(60, 79), 1);
  EXPECT_EQ(depth.depth.at<float>(60, 80), 0);
}

TEST(RemoveEdges, RemovesWhatIsBesideAnEdgeAlone) {
  KeyframeDepth depth = step();
  depth.depth.col(79).setTo(1.4F);  // a depth between the two surfaces
  remove_edges(depth, 0.02);
  for (int u = 0; u < 160; ++u) EXPECT_EQ(depth.depth.at<float>(60, u) > 0, u < 77 || u > 81) << u;
}

TEST(RemoveEdges, KeepsSlantedPlanes) {
  const auto slanted = [](const Eigen::Vector3d&, const Eigen::Vector3d& ray) {
    return 1 / (0.5 + 0.9 * ray[0]);  // inverse depth 0.02 to 0.98
  };
  KeyframeDepth depth = rendered_depth(SE3(), 0.0001, slanted);
  const int before = cv::countNonZero(depth.depth);
  remove_edges(depth, 0.02);
  EXPECT_EQ(cv::countNonZero(depth.depth), before);
}

TEST(EstimateNormals, AreThoseOfAPlaneTowardsTheCamera) {
  const Eigen::Vector3d plane(0.3, -0.2, 0.5);  // plane . p = 1
  KeyframeDepth depth = rendered_depth(
      SE3(), 0.001, [&](const auto&, const auto& ray) { return 1 / plane.dot(ray); });
  estimate_normals(depth, 3, 0.1);
  const auto& n = depth.normal.at<cv::Vec3f>(60, 80);
  EXPECT_LT((Eigen::Vector3d(n[0], n[1], n[2]) + plane.normalized()).norm(), 1e-3);
  EXPECT_GT(depth.depth.at<float>(60, 80), 0);
}

TEST(EstimateNormals, DropsGrazingSurfacesAndLonePixels) {
  const Eigen::Vector3d grazing(1, 0, 0.01);  // almost along the rays in the middle
  KeyframeDepth depth = rendered_depth(SE3(), 0.001, [&](const auto&, const auto& ray) {
    const double w = grazing.dot(ray);
    return w > 0 ? 1 / w : 0.0;
  });
  estimate_normals(depth, 3, 0.1);
  EXPECT_EQ(depth.depth.at<float>(60, 82), 0);
  EXPECT_GT(depth.depth.at<float>(60, 140), 0);

  KeyframeDepth lone = rendered_depth(SE3(), 0.001, [](const auto&, const auto&) { return 0.0; });
  lone.depth.at<float>(60, 80) = 1;
  estimate_normals(lone, 3, 0.1);
  EXPECT_EQ(cv::countNonZero(lone.depth), 0);
}

}  // namespace depth_cleaning_test
}  // namespace placegraph
