// Vanishing points and rectangular worlds of generated scenes.
#include <gtest/gtest.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/scenes/manhattan_scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace manhattan_test {

double error_of(const SO3& R_cam_manhattan, const SO3& truth) {
  return (nearest_axes(R_cam_manhattan, truth).inverse() * truth).log().norm();
}

/// Mean of e^T C^-1 e over degrees of freedom: within [0.5, 2] whatever the seed.
TEST(Manhattan, CovarianceOfTheFrameIsThatOfItsError) {
  Random random = test::seeded_random(1);
  const Camera camera = test::vanishing_camera();
  for (const double noise_px : {0.2, 0.6}) {
    double sum = 0;
    constexpr int kScenes = 40;
    for (int k = 0; k < kScenes; ++k) {
      const SO3 R = test::random_rotation(std::numbers::pi, random);
      const auto segments = test::manhattan_segments(camera, R, 30, 30, noise_px, random);
      const auto frame = estimate_manhattan_frame(segments, camera, {}, {}, random);
      ASSERT_TRUE(frame.outcome) << frame.outcome.reason;
      const SO3 truth = nearest_axes(R, frame.R_cam_manhattan);
      const Eigen::Vector3d e = (frame.R_cam_manhattan.inverse() * truth).log();
      ASSERT_LT(e.norm(), 0.02);
      sum += e.dot(frame.information * e) / 3;
    }
    EXPECT_GT(sum / kScenes, 0.5) << noise_px;
    EXPECT_LT(sum / kScenes, 2) << noise_px;
  }
}

TEST(Manhattan, CovarianceOfATrackedFrameIsThatOfItsError) {
  Random random = test::seeded_random(2);
  const Camera camera = test::vanishing_camera();
  double sum = 0;
  constexpr int kScenes = 80;
  for (int k = 0; k < kScenes; ++k) {
    const SO3 R = test::random_rotation(std::numbers::pi, random);
    const auto segments = test::manhattan_segments(camera, R, 30, 30, 0.3, random);
    const auto frame = track_manhattan_frame(segments, camera,
                                             R * test::random_rotation(0.05, random), 0.03, {}, {});
    ASSERT_TRUE(frame.outcome) << frame.outcome.reason;
    const Eigen::Vector3d e = (frame.R_cam_manhattan.inverse() * R).log();
    sum += e.dot(frame.information * e) / 3;
  }
  EXPECT_GT(sum / kScenes, 0.5);
  EXPECT_LT(sum / kScenes, 2);
}

TEST(Manhattan, CovarianceOfAVanishingPointIsThatOfItsError) {
  Random random = test::seeded_random(3);
  const Camera camera = test::vanishing_camera();
  double sum = 0;
  constexpr int kScenes = 60;
  for (int k = 0; k < kScenes; ++k) {
    const Eigen::Vector3d v = test::random_rotation(std::numbers::pi, random).matrix().col(2);
    std::vector<LineSegment> segments;
    test::add_edges(camera, v, 40, 0.3, random, segments);
    test::add_clutter(camera, 20, random, segments);
    const auto found = find_vanishing_points(segments, camera, {}, random);
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    const VanishingPoint& point = found.points[0];
    Eigen::Matrix<double, 3, 2> B;
    B.col(0) = point.direction.unitOrthogonal();
    B.col(1) = point.direction.cross(B.col(0));
    const Eigen::Vector2d e = B.transpose() * (v.dot(point.direction) < 0 ? -v : v);
    ASSERT_LT(e.norm(), 0.1);
    const Eigen::Matrix2d covariance = B.transpose() * point.covariance * B;
    sum += e.dot(covariance.inverse() * e) / 2;
  }
  EXPECT_GT(sum / kScenes, 0.5);
  EXPECT_LT(sum / kScenes, 2);
}

TEST(Manhattan, FoliageShowsNoWorld) {
  Random random = test::seeded_random(4);
  const Camera camera = test::vanishing_camera();
  int worlds = 0, points = 0;
  constexpr int kScenes = 40;
  for (int k = 0; k < kScenes; ++k) {
    std::vector<LineSegment> segments;
    test::add_clutter(camera, 50 + 10 * k, random, segments);
    const auto scene = find_scene_directions(segments, camera, {}, random);
    worlds += static_cast<int>(scene.frames.size());
    points += static_cast<int>(scene.vanishing.points.size());
  }
  EXPECT_LE(worlds, 1);
  EXPECT_LE(points, kScenes / 8);
}

TEST(Manhattan, TwoWorldsOnOneGroundAreKeptApart) {
  Random random = test::seeded_random(5);
  const Camera camera = test::vanishing_camera();
  int both = 0;
  constexpr int kScenes = 30;
  for (int k = 0; k < kScenes; ++k) {
    const SO3 first = SO3::exp({0.1, random.uniform(-0.3, 0.3), 0.05});
    const SO3 second = first * SO3::exp({0, random.uniform(0.35, 0.8), 0});
    auto segments = test::manhattan_segments(camera, first, 40, 20, 0.3, random);
    for (const int a : {0, 2})
      test::add_edges(camera, second.matrix().col(a), 30, 0.3, random, segments);
    const auto scene = find_scene_directions(segments, camera, {}, random);
    ASSERT_GE(scene.frames.size(), 1u);
    if (scene.frames.size() != 2) continue;
    const SO3 &a = scene.frames[0].R_cam_manhattan, &b = scene.frames[1].R_cam_manhattan;
    both += (error_of(a, first) < 0.01 && error_of(b, second) < 0.01) ||
            (error_of(a, second) < 0.01 && error_of(b, first) < 0.01);
  }
  EXPECT_GE(both, kScenes * 9 / 10);
}

TEST(Manhattan, AxesThatAreNotQuiteAtRightAnglesWidenTheCovariance) {
  Random random = test::seeded_random(6);
  const Camera camera = test::vanishing_camera();
  double deviation = 0;
  int within = 0;
  constexpr int kScenes = 60;
  for (int k = 0; k < kScenes; ++k) {
    const SO3 R = test::random_rotation(std::numbers::pi, random);
    std::vector<LineSegment> segments;
    for (int a = 0; a < 3; ++a) {
      // each axis off its right angle by a degree, at random
      const Eigen::Vector3d w(random.normal(), random.normal(), random.normal());
      test::add_edges(camera, R * SO3::exp(kRadPerDeg * w) * Eigen::Vector3d::Unit(a), 40, 0.3,
                      random, segments);
    }
    const auto frame = estimate_manhattan_frame(segments, camera, {}, {}, random);
    if (!frame.outcome) continue;
    const SO3 truth = nearest_axes(R, frame.R_cam_manhattan);
    const Eigen::Vector3d e = (frame.R_cam_manhattan.inverse() * truth).log();
    within += e.dot(frame.information * e) < 11.3;  // 99 % of chi^2 with three degrees
    deviation += frame.orthogonality_deg / kScenes;
  }
  EXPECT_GT(deviation, 0.3);
  EXPECT_GE(within, kScenes * 3 / 4);  // three angles are few to tell a variance by
}

}  // namespace manhattan_test
}  // namespace placegraph
