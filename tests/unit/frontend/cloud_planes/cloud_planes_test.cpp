#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/clouds.h"

namespace placegraph {
namespace cloud_planes_test {

using test::look_at;
using test::regions_found;
using test::Seen;
using test::SeenCloud;

CloudPlanesResult find(const PointCloud& cloud, const CloudPlanesOptions& options = {}) {
  return find_cloud_planes(cloud, options, built_in_planarity());
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return rad_to_deg(std::asin(std::min(1.0, a.cross(b).norm() / b.norm())));
}

TEST(CloudPlanes, FindsTheThreePlanesOfACornerAtAnyScale) {
  for (const double scale : {0.1, 1.0, 20.0}) {
    const SeenCloud seen = look_at(test::see_corner, scale, 1e-3);
    const CloudPlanesResult result = find(seen.cloud);
    ASSERT_TRUE(result.outcome);
    EXPECT_EQ(result.planes.size(), 3u) << scale;
    EXPECT_EQ(regions_found(seen.labels, result.labels), 3) << scale;
    for (const CloudPlane& plane : result.planes) {
      double least = 90;
      for (const Eigen::Vector3d& n :
           {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(-0.8, 0, 0.6)})
        least = std::min(least, degrees_between(plane.plane.normal, n));
      EXPECT_LT(least, 0.3);  // thousands of points with 1e-3 of noise: hundredths of a degree
      EXPECT_NEAR(plane.chi2_per_dof, 1, 0.5);
    }
  }
}

TEST(CloudPlanes, FindsTheSameInACloudWithoutPixelsOrViewpoint) {
  SeenCloud seen = test::unorganised(look_at(test::see_corner, 1, 5e-4));
  EXPECT_EQ(regions_found(seen.labels, find(seen.cloud).labels), 3);
  // From elsewhere the points are not one surface along each ray any more.
  for (Eigen::Vector3d& p : seen.cloud.points) p += Eigen::Vector3d(-0.5, -0.8, -2.6);
  EXPECT_EQ(regions_found(seen.labels, find(seen.cloud).labels, 0.8), 3);
}

TEST(CloudPlanes, TellsPlanesThreeCentimetresApart) {
  const auto scene = [](const Eigen::Vector3d& ray) {
    return Seen{ray.x() < 0 ? 1.5 : 1.53, ray.x() < 0 ? 1 : 2};
  };
  const SeenCloud seen = look_at(scene, 1, 2e-3);  // 3 mm of noise
  const CloudPlanesResult result = find(seen.cloud);
  ASSERT_EQ(result.planes.size(), 2u);
  EXPECT_EQ(regions_found(seen.labels, result.labels), 2);
  // The offset of a mean of ten thousand: 0.03 mm, and a tilt that the fit leaves open.
  EXPECT_NEAR(std::abs(result.planes[0].plane.distance_m - result.planes[1].plane.distance_m), 0.03,
              2e-3);
}

TEST(CloudPlanes, LeavesABallToNoPlane) {
  const auto scene = [](const Eigen::Vector3d& ray) {
    const Eigen::Vector3d centre(0, 0, 1.5);
    const double a = ray.squaredNorm(), b = ray.dot(centre), c = centre.squaredNorm() - 0.25;
    const double under = b * b - a * c;
    return under > 0 ? Seen{(b - std::sqrt(under)) / a, 0} : Seen{2.5, 1};
  };
  const SeenCloud seen = look_at(scene, 1, 5e-4);
  const CloudPlanesResult result = find(seen.cloud);
  EXPECT_EQ(regions_found(seen.labels, result.labels), 1);
  int ball = 0, of_ball = 0;
  for (std::size_t i = 0; i < seen.labels.size(); ++i) {
    if (seen.labels[i] != 0) continue;
    ++ball;
    of_ball += result.labels[i] > 0;
  }
  EXPECT_LT(of_ball, ball / 5);
}

TEST(CloudPlanes, MeasuresTheNoiseAndItsGrowth) {
  const auto slanted = [](const Eigen::Vector3d& ray) {
    return test::see_planes(ray, {{0, 0.95, 0.3, 1.2}, {0, 0, 1, 8}});
  };
  const CloudPlanesResult result = find(look_at(slanted, 1, 4e-3).cloud);
  EXPECT_EQ(result.noise.power, 1);
  EXPECT_NEAR(result.noise.at_1m, 4e-3, 1e-3);
}

TEST(CloudPlanes, ClaimsTheCovarianceThatItsPlanesScatterBy) {
  const auto wall = [](const Eigen::Vector3d& ray) {
    return test::see_planes(ray, {{0.3, 0.2, std::sqrt(1 - 0.13), 2}});
  };
  const Eigen::Vector3d truth = 2 * Eigen::Vector3d(0.3, 0.2, std::sqrt(1 - 0.13));
  double sum = 0;
  constexpr int kRuns = 8;
  for (int k = 0; k < kRuns; ++k) {
    const CloudPlanesResult result = find(look_at(wall, 1, 2e-3, 10 + k).cloud);
    ASSERT_EQ(result.planes.size(), 1u);
    const CloudPlane& plane = result.planes[0];
    const Eigen::Vector3d off = plane.plane.normal * plane.plane.distance_m - truth;
    sum += off.dot(plane.covariance.inverse() * off);
  }
  // chi2 of 24 degrees of freedom: below 51 in 999 of 1000; the noise is known to a tenth.
  EXPECT_LT(sum, 70);
  EXPECT_GT(sum, 7);
}

TEST(CloudPlanes, HasBaselinesThatFindACorner) {
  const SeenCloud seen = look_at(test::see_corner, 1, 2e-4);
  for (const CloudPlanesMethod method : {CloudPlanesMethod::kRansac, CloudPlanesMethod::kGrowing}) {
    CloudPlanesOptions options;
    options.method = method;
    EXPECT_EQ(regions_found(seen.labels, find(seen.cloud, options).labels, 0.8), 3);
  }
}

TEST(CloudPlanes, GivesTheSameBitsAgain) {
  const SeenCloud seen = look_at(test::see_corner, 1, 1e-3);
  const CloudPlanesResult a = find(seen.cloud), b = find(seen.cloud);
  EXPECT_EQ(a.labels, b.labels);
  ASSERT_EQ(a.planes.size(), b.planes.size());
  for (std::size_t k = 0; k < a.planes.size(); ++k) {
    EXPECT_EQ(a.planes[k].plane.normal, b.planes[k].plane.normal);
    EXPECT_EQ(a.planes[k].covariance, b.planes[k].covariance);
  }
}

TEST(CloudPlanes, FindsNoneInNoiseAndRefusesWhatCannotBe) {
  Random random(3);
  PointCloud cloud;
  for (int i = 0; i < 800; ++i)
    cloud.points.emplace_back(random.normal(), random.normal(), random.normal());
  const CloudPlanesResult result = find(cloud);
  EXPECT_TRUE(result.outcome);
  EXPECT_THAT(result.planes, ::testing::IsEmpty());
  cloud.points.resize(5);
  EXPECT_EQ(find(cloud).outcome.code, Outcome::Code::kTooFewData);
  cloud.points.assign(100, Eigen::Vector3d(1, 2, 3));  // all at one place
  EXPECT_THAT(find(cloud).planes, ::testing::IsEmpty());
  cloud.points.clear();
  for (int i = 0; i < 100; ++i) cloud.points.emplace_back(0.1 * i, 2, 3);  // on a line
  EXPECT_THAT(find(cloud).planes, ::testing::IsEmpty());
  cloud.width = 7, cloud.height = 3;
  EXPECT_THROW((void)find(cloud), ArgumentError);
  CloudPlanesOptions options;
  options.inlier_sigmas = 0;
  EXPECT_THROW((void)find(PointCloud{}, options), ArgumentError);
}

}  // namespace cloud_planes_test
}  // namespace placegraph
