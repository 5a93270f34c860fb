#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/depth_planes.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/scenes/clouds.h"

namespace placegraph {
namespace depth_planes_test {

/// What a depth camera of 320x240 sees of the nearest of planes n^T X = d.
struct Observation {
  double sigma_inverse_depth = 0;
  int block_px = 1;  ///< pixels that err alike
  std::uint64_t seed = 1;
};

Camera camera() {
  return {.width = 320, .height = 240, .fx = 280, .fy = 280, .cx = 159.5, .cy = 119.5};
}

Image render_view(const std::vector<Eigen::Vector4d>& planes, const Observation& observation) {
  const Camera c = camera();
  Random random(observation.seed);
  Image depth(c.height, c.width, CV_32FC1, cv::Scalar(0));
  Image noise(c.height / observation.block_px + 1, c.width / observation.block_px + 1, CV_32FC1);
  for (int y = 0; y < noise.rows; ++y)
    for (int x = 0; x < noise.cols; ++x)
      noise.at<float>(y, x) = static_cast<float>(observation.sigma_inverse_depth * random.normal());
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const test::Seen seen = test::see_planes({(x - c.cx) / c.fx, (y - c.cy) / c.fy, 1}, planes);
      if (!(seen.depth > 0) || !std::isfinite(seen.depth)) continue;
      depth.at<float>(y, x) = static_cast<float>(
          1 / (1 / seen.depth + static_cast<double>(noise.at<float>(y / observation.block_px,
                                                                    x / observation.block_px))));
    }
  return depth;
}

/// Floor, a wall on the left and one ahead.
const std::vector<Eigen::Vector4d> kCorner = {
    {0, 1, 0, 0.7}, {-0.8, 0, 0.6, 1.6}, {0.5, 0.02, 0.866, 2.5}};

Plane3 plane_of(const Eigen::Vector4d& n_d) { return Plane3(n_d.head<3>(), n_d[3]); }

DepthPlanesOptions small() {
  DepthPlanesOptions options;
  options.floor_deg = 1e-3;
  options.floor_distance = 1e-5;
  return options;
}

/// The plane nearest to a true one.
const DepthPlane* find(const std::vector<DepthPlane>& planes, const Plane3& truth) {
  const DepthPlane* best = nullptr;
  double least = 0.2;
  for (const DepthPlane& plane : planes)
    if (const double off = plane.plane_cam.minus(truth).norm(); off < least)
      best = &plane, least = off;
  return best;
}

TEST(DepthPlanes, AreThoseOfACorner) {
  const auto planes = find_depth_planes(render_view(kCorner, {}), camera(), small());
  ASSERT_EQ(planes.size(), 3u);
  for (const Eigen::Vector4d& truth : kCorner) {
    const DepthPlane* const plane = find(planes, plane_of(truth));
    ASSERT_TRUE(plane);
    // Depths are floats.
    EXPECT_LT(plane->plane_cam.minus(plane_of(truth)).norm(), 1e-3);
    for (const Eigen::Vector3d& p : plane->points_cam)
      EXPECT_NEAR(truth.head<3>().dot(p), truth[3], 0.01);
  }
}

/// Normalized squared errors against the truth over many images, per degree of freedom.
double anees(const Observation& observation, const DepthPlanesOptions& options, int* missing) {
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Observation one = observation;
    one.seed = seed;
    const auto planes = find_depth_planes(render_view(kCorner, one), camera(), options);
    for (const Eigen::Vector4d& truth : kCorner) {
      const DepthPlane* const plane = find(planes, plane_of(truth));
      if (!plane) {
        ++*missing;
        continue;
      }
      const Eigen::Vector3d e = plane->plane_cam.minus(plane_of(truth));
      sum += e.dot(plane->covariance.llt().solve(e));
      ++count;
    }
  }
  return sum / (3 * count);
}

TEST(DepthPlanes, AreAsFarOffAsTheirCovariancesSay) {
  int missing = 0;
  const double independent = anees({.sigma_inverse_depth = 0.004}, small(), &missing);
  EXPECT_EQ(missing, 0);
  EXPECT_GT(independent, 0.3);
  EXPECT_LT(independent, 2);
  // Blocks of pixels that err alike: noise that does not average out over neighbours.
  const double similar = anees({.sigma_inverse_depth = 0.002, .block_px = 11}, small(), &missing);
  EXPECT_EQ(missing, 0);
  EXPECT_GT(similar, 0.2);
  EXPECT_LT(similar, 2.5);
}

TEST(DepthPlanes, AreNeverSurerThanTheFloor) {
  DepthPlanesOptions options;
  options.floor_deg = 0.3;
  options.floor_distance = 0.01;
  const auto planes = find_depth_planes(render_view(kCorner, {}), camera(), options);
  ASSERT_EQ(planes.size(), 3u);
  for (const DepthPlane& plane : planes) {
    Eigen::RowVector3d J;
    const double distance = plane.plane_cam.distance(&J);
    EXPECT_GE(J.dot(plane.covariance * J.transpose()), std::pow(0.0099 * distance, 2));
  }
}

TEST(DepthPlanes, ADoorLeafBeforeItsWallIsAPlaneOfItsOwn) {
  // A wall ahead, 2 m away, with a leaf 3 cm before it in the middle.
  Image depth = render_view({{0, 0, 1, 2}}, {.sigma_inverse_depth = 0.0005});
  depth(cv::Rect(96, 48, 112, 176)) = 1.97F;
  const auto planes = find_depth_planes(depth, camera(), small());
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_NEAR(std::abs(planes[0].plane_cam.distance()), 2, 1e-3);
  EXPECT_NEAR(std::abs(planes[1].plane_cam.distance()), 1.97, 1e-3);
}

TEST(DepthPlanes, PartsOfAWallBesideAPillarAreOne) {
  Image depth = render_view({{0.1, 0, 1, 2}}, {.sigma_inverse_depth = 0.0005});
  depth(cv::Rect(128, 0, 48, 240)) = 1.2F;
  DepthPlanesOptions options = small();
  options.min_share = 0.2;  // the pillar is too narrow
  const auto planes = find_depth_planes(depth, camera(), options);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_GT(planes[0].points_cam.size(), 200u);
}

TEST(DepthPlanes, ABallAndNothingHaveNone) {
  const Camera c = camera();
  EXPECT_TRUE(find_depth_planes(Image(c.height, c.width, CV_32FC1, cv::Scalar(0)), c).empty());
  Image depth(c.height, c.width, CV_32FC1, cv::Scalar(0));
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      // A ball of 0.8 m, its middle 1.5 m away.
      const Eigen::Vector3d ray((x - c.cx) / c.fx, (y - c.cy) / c.fy, 1);
      const double a = ray.squaredNorm(), b = 1.5, root = b * b - a * (1.5 * 1.5 - 0.64);
      if (root > 0) depth.at<float>(y, x) = static_cast<float>((b - std::sqrt(root)) / a);
    }
  DepthPlanesOptions options;
  options.min_share = 0.1;
  EXPECT_TRUE(find_depth_planes(depth, c, options).empty());
}

TEST(DepthPlanes, GoIntoAnotherFrameWithTheirCovariance) {
  const auto planes =
      find_depth_planes(render_view(kCorner, {.sigma_inverse_depth = 0.002}), camera());
  ASSERT_FALSE(planes.empty());
  const SE3 T_new_old(SO3::exp({0.1, -0.3, 0.2}), Eigen::Vector3d(0.4, 0.1, -0.2));
  const DepthPlane there = transform(T_new_old, planes[0]);
  for (const Eigen::Vector3d& p : there.points_cam)
    EXPECT_NEAR(there.plane_cam.distance_to(p), 0, 1e-9);
  const DepthPlane back = transform(T_new_old.inverse(), there);
  EXPECT_LT(back.plane_cam.minus(planes[0].plane_cam).norm(), 1e-12);
  EXPECT_LT((back.covariance - planes[0].covariance).norm(), 1e-9 * planes[0].covariance.norm());
}

TEST(DepthPlanes, RefuseAnImageOfAnotherKind) {
  const Camera c = camera();
  EXPECT_THROW((void)find_depth_planes(Image(c.height, c.width, CV_16UC1, cv::Scalar(0)), c),
               ArgumentError);
  EXPECT_THROW((void)find_depth_planes(Image(60, 80, CV_32FC1, cv::Scalar(0)), c), ArgumentError);
  DepthPlanesOptions options;
  options.cell_px = 3;
  EXPECT_THROW((void)find_depth_planes(render_view(kCorner, {}), c, options), ArgumentError);
}

}  // namespace depth_planes_test
}  // namespace placegraph
