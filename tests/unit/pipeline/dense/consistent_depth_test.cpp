#include <gtest/gtest.h>
#include <placegraph/pipeline/dense/consistent_depth.h>

#include "tests/unit/pipeline/dense/rendered_depth.h"

namespace placegraph {
namespace consistent_depth_test {

using test::GivenDepth;
using test::plane_depth;
using test::rendered_depth;

/// A wall at z = 2, seen from positions 5 cm apart.
std::vector<KeyframeDepth> views_of_wall(int count) {
  std::vector<KeyframeDepth> views;
  for (int i = 0; i < count; ++i)
    views.push_back(rendered_depth(SE3(SO3(), {0.05 * i, 0, 0}), 0.002, plane_depth));
  return views;
}

TEST(ConsistentDepth, KeepsWhatThreeViewsSee) {
  ConsistentDepth depth(std::make_unique<GivenDepth>(views_of_wall(3)));
  const KeyframeDepth seen = depth.of(1);
  EXPECT_GT(cv::countNonZero(seen.depth), 0.9 * seen.depth.total());
  EXPECT_NEAR(seen.depth.at<float>(60, 80), 2, 1e-5);
  EXPECT_LT(
      (Eigen::Vector3f(seen.normal.at<cv::Vec3f>(60, 80).val) - Eigen::Vector3f(0, 0, -1)).norm(),
      1e-4);
}

TEST(ConsistentDepth, TwoViewsAreTooFew) {
  ConsistentDepth depth(std::make_unique<GivenDepth>(views_of_wall(2)));
  EXPECT_EQ(cv::countNonZero(depth.of(0).depth), 0);
}

/// The wall with a plate in front of it, at depth 1.5 around the optical axis of the first view.
double plate_depth(const Eigen::Vector3d& centre, const Eigen::Vector3d& ray) {
  const Eigen::Vector3d p = centre + (1.5 - centre[2]) / ray[2] * ray;
  return p.head<2>().norm() < 0.3 ? 1.5 - centre[2] : plane_depth(centre, ray);
}

TEST(ConsistentDepth, DropsWhatMoreViewsSeeThroughThanSee) {
  for (const int seeing_through : {1, 4}) {
    std::vector<KeyframeDepth> views = views_of_wall(3 + seeing_through);
    for (int i = 0; i < 3; ++i)
      views[static_cast<std::size_t>(i)] =
          rendered_depth(SE3(SO3(), {0.05 * i, 0, 0}), 0.002, plate_depth);
    ConsistentDepth depth(std::make_unique<GivenDepth>(views));
    const KeyframeDepth seen = depth.of(1);
    EXPECT_NEAR(seen.depth.at<float>(60, 80), seeing_through == 1 ? 1.5 : 0, 1e-5);
    EXPECT_NEAR(seen.depth.at<float>(60, 20), 2, 1e-5);
  }
}

TEST(ConsistentDepth, WhatIsHiddenIsNoContradiction) {
  std::vector<KeyframeDepth> views = views_of_wall(6);
  for (const std::size_t i : {3, 4, 5}) views[i].depth.setTo(0.5F);  // something stands before them
  ConsistentDepth depth(std::make_unique<GivenDepth>(views));
  EXPECT_NEAR(depth.of(1).depth.at<float>(60, 80), 2, 1e-5);
}

TEST(ConsistentDepth, TakesTheMeanOfThoseThatAgree) {
  std::vector<KeyframeDepth> views = views_of_wall(3);
  views[0].depth.setTo(1.98F);
  views[2].depth.setTo(1.98F);
  ConsistentDepth depth(std::make_unique<GivenDepth>(views));
  const double mean = depth.of(1).depth.at<float>(60, 80);
  EXPECT_NEAR(mean, 3 / (1 / 2.0 + 2 / 1.98), 1e-3);
}

TEST(ConsistentDepth, ReadsEveryImageOnce) {
  auto source = std::make_unique<GivenDepth>(views_of_wall(20));
  const GivenDepth& given = *source;
  ConsistentDepth depth(std::move(source));
  for (std::size_t i = 0; i < depth.size(); ++i) depth.of(i);
  EXPECT_EQ(given.reads, 20);
}

}  // namespace consistent_depth_test
}  // namespace placegraph
