#include <gtest/gtest.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/frontend/vanishing/vanishing_evidence.h>
#include <placegraph/frontend/vanishing/vanishing_model.h>
#include <placegraph/frontend/vanishing/vanishing_points.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/manhattan_scene.h"

namespace placegraph {
namespace vanishing_points_test {

using Code = Outcome::Code;

/// A segment through `px` that points at the direction `v`.
LineSegment pointing_at(const Camera& camera, const Eigen::Vector3d& v, const Eigen::Vector2d& px,
                        double length) {
  const Eigen::Vector3d to = camera.K() * v;
  const Eigen::Vector2d path = (to.head<2>() - to.z() * px).normalized();
  return {px - 0.5 * length * path, px + 0.5 * length * path};
}

std::vector<LineSegment> star(const Camera& camera, const Eigen::Vector3d& v, int count,
                              double du = 0) {
  std::vector<LineSegment> segments;
  for (int i = 0; i < count; ++i)
    segments.push_back(pointing_at(
        camera, v, {60.0 + du + 37 * ((i * 7) % 13), 40.0 + 61 * ((i * 5) % 7)}, 40 + 3 * (i % 9)));
  return segments;
}

TEST(VanishingEvidence, SegmentThatPointsThereHasNoError) {
  const Camera camera = test::vanishing_camera();
  for (const Eigen::Vector3d& v : {Eigen::Vector3d(0.3, -0.2, 1), Eigen::Vector3d(1, 0.1, 0)}) {
    const VanishingEvidence evidence({pointing_at(camera, v, {100, 200}, 50)}, camera, {});
    EXPECT_NEAR(evidence.error(0, v.normalized()).sine, 0, 1e-12);
    EXPECT_NEAR(evidence.error(0, -v.normalized()).sine, 0, 1e-12);
  }
}

TEST(VanishingEvidence, VarianceIsThatOfTheEndsAndOfTheScene) {
  const Camera camera = test::vanishing_camera();
  VanishingNoise noise;
  noise.end_px = 0.5;
  noise.parallel_deg = 0.1;
  const Eigen::Vector3d far(1, 0, 0);  // at infinity to the right
  const VanishingEvidence evidence({{{100, 200}, {150, 200}}}, camera, noise);
  const double rotation = std::sqrt(2.0) * 0.5 / 50, parallel = deg_to_rad(0.1);
  EXPECT_NEAR(evidence.error(0, far).variance, rotation * rotation + parallel * parallel, 1e-12);
  // 175 px from the middle: the middle's own shift of 0.5 / sqrt(2) px is seen as an angle, too
  const Eigen::Vector3d near = camera.unproject({300, 200})->normalized();
  const double shift = 0.5 / std::sqrt(2.0) / 175;
  EXPECT_NEAR(evidence.error(0, near).variance,
              rotation * rotation + parallel * parallel + shift * shift, 1e-10);
}

TEST(VanishingEvidence, JacobianIsThatOfFiniteDifferences) {
  const Camera camera = test::vanishing_camera();
  const VanishingEvidence evidence({{{100, 200}, {150, 240}}}, camera, {});
  const Eigen::Vector3d v = Eigen::Vector3d(0.4, 0.1, 0.9).normalized();
  const PointingError e = evidence.error(0, v);
  for (int k = 0; k < 3; ++k) {
    constexpr double h = 1e-6;
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    EXPECT_NEAR(e.J_sine_v[k],
                (evidence.error(0, v + step).sine - evidence.error(0, v - step).sine) / (2 * h),
                1e-7);
  }
  EXPECT_NEAR(e.J_sine_v.dot(v), 0, 1e-12);
}

TEST(VanishingEvidence, PiecesOfOneEdgeCountAsOne) {
  const Camera camera = test::vanishing_camera();
  const VanishingEvidence evidence(
      {{{10, 100}, {60, 100}}, {{100, 100}, {190, 100}}, {{10, 300}, {60, 340}}}, camera, {});
  EXPECT_DOUBLE_EQ(evidence.weight(0), 0.5);
  EXPECT_DOUBLE_EQ(evidence.weight(1), 0.5);
  EXPECT_DOUBLE_EQ(evidence.weight(2), 1);
}

TEST(VanishingEvidence, RefusesSegmentsWithoutLengthAndNoiseOutOfRange) {
  const Camera camera = test::vanishing_camera();
  EXPECT_THROW(VanishingEvidence({{{10, 10}, {10, 10}}}, camera, {}), ArgumentError);
  VanishingNoise noise;
  noise.end_px = 0;
  EXPECT_THROW(VanishingEvidence({}, camera, noise), ArgumentError);
  EXPECT_THROW(VanishingEvidence({}, Camera(), {}), ArgumentError);
}

TEST(VanishingPoints, FewerSegmentsThanAPointNeedsAreTooFew) {
  const Camera camera = test::vanishing_camera();
  for (const int count : {0, 1, 3}) {
    Random random(1);
    const auto result = find_vanishing_points(star(camera, {0, 0, 1}, count), camera, {}, random);
    EXPECT_EQ(result.outcome.code, Code::kTooFewData);
    EXPECT_TRUE(result.points.empty());
    EXPECT_EQ(result.labels.size(), static_cast<std::size_t>(count));
  }
}

TEST(VanishingPoints, FindsOneInsideTheImage) {
  const Camera camera = test::vanishing_camera();
  const Eigen::Vector3d v = Eigen::Vector3d(0.2, -0.1, 1).normalized();
  Random random(1);
  const auto result = find_vanishing_points(star(camera, v, 40), camera, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  ASSERT_EQ(result.points.size(), 1u);
  EXPECT_LT((result.points[0].direction - v).norm(), 1e-4);
  EXPECT_GE(result.points[0].segments, 38);
  EXPECT_NEAR((result.points[0].covariance * v).norm(), 0, 1e-9);
}

TEST(VanishingPoints, ParallelSegmentsMeetAtInfinity) {
  const Camera camera = test::vanishing_camera();
  const Eigen::Vector3d v = Eigen::Vector3d(1, 0.3, 0).normalized();
  Random random(1);
  const auto scene = find_scene_directions(star(camera, v, 40), camera, {}, random);
  ASSERT_TRUE(scene.vanishing.outcome) << scene.vanishing.outcome.reason;
  ASSERT_EQ(scene.vanishing.points.size(), 1u);
  EXPECT_GT(std::abs(scene.vanishing.points[0].direction.dot(v)), 1 - 1e-8);
  EXPECT_TRUE(scene.frames.empty());  // one direction leaves a turn open
}

TEST(VanishingPoints, SegmentsOnOneLineMeetNowhere) {
  const Camera camera = test::vanishing_camera();
  std::vector<LineSegment> segments;
  for (int i = 0; i < 20; ++i)
    segments.push_back({{20.0 + 30 * i, 100.0 + 3 * i}, {40.0 + 30 * i, 102.0 + 3 * i}});
  Random random(1);
  const auto result = find_vanishing_points(segments, camera, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kNoConsensus);
  EXPECT_EQ(result.labels, std::vector<int>(20, -1));
}

TEST(VanishingPoints, SameSeedSameAnswer) {
  const Camera camera = test::vanishing_camera();
  Random made(3);
  const auto segments =
      test::manhattan_segments(camera, SO3::exp({0.1, 0.4, 0.05}), 30, 60, 0.4, made);
  Random a(9), b(9);
  const auto first = find_scene_directions(segments, camera, {}, a);
  const auto second = find_scene_directions(segments, camera, {}, b);
  EXPECT_EQ(first.vanishing.labels, second.vanishing.labels);
  ASSERT_EQ(first.frames.size(), 1u);
  EXPECT_EQ(first.frames[0].R_cam_manhattan.matrix(), second.frames[0].R_cam_manhattan.matrix());
}

TEST(SceneDirections, PointsOfAWorldAreItsAxes) {
  const Camera camera = test::vanishing_camera();
  const SO3 R = SO3::exp({0.1, 0.5, 0.05});
  Random random(5);
  auto segments = test::manhattan_segments(camera, R, 40, 20, 0.3, random);
  const Eigen::Vector3d oblique = R * Eigen::Vector3d(0.64, 0, 0.77).normalized();
  test::add_edges(camera, oblique, 40, 0.3, random, segments);
  const auto scene = find_scene_directions(segments, camera, {}, random);
  ASSERT_GE(scene.frames.size(), 1u);
  EXPECT_LT((scene.frames[0].R_cam_manhattan.inverse() * R).log().norm(), 0.005);
  ASSERT_EQ(scene.vanishing.points.size(), 4u);
  int axes = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d v = scene.vanishing.points[i].direction;
    if (scene.roles[i].frame == 0) {
      ++axes;
      EXPECT_GT(std::abs(v.dot(R.matrix().col(scene.roles[i].axis))), 0.9999);
    } else {
      EXPECT_GT(std::abs(v.dot(oblique)), 0.9999);
      // At right angles to the upright axis: of a world of its own with it, or told to lie across
      // it.
      const PointRole role = scene.roles[i];
      const int frame = role.axis >= 0 ? role.frame : role.across_frame;
      ASSERT_GE(frame, 0);
      const Eigen::Matrix3d axes_seen =
          scene.frames[static_cast<std::size_t>(frame)].R_cam_manhattan.matrix();
      const Eigen::Vector3d upright = R * Eigen::Vector3d::UnitY();
      EXPECT_GT((axes_seen.transpose() * upright).cwiseAbs().maxCoeff(), 0.999);
      if (role.across_axis >= 0) {
        EXPECT_GT(std::abs(axes_seen.col(role.across_axis).dot(upright)), 0.999);
      }
    }
  }
  EXPECT_EQ(axes, 3);
  // Segments 0 .. 39 lie along the first axis: labels are numbers of points.
  int right = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    const int label = scene.vanishing.labels[i];
    right += label >= 0 && scene.roles[static_cast<std::size_t>(label)].frame == 0 &&
             scene.roles[static_cast<std::size_t>(label)].axis == 0;
  }
  EXPECT_GE(right, 36);
}

TEST(SceneDirections, TellsWhichAxisFurtherPointsLieAcross) {
  const Camera camera = test::vanishing_camera();
  const SO3 R = SO3::exp({0.1, 0.5, 0.05});
  // Level, 30 degrees off an axis, and nowhere at right angles. The level ones and the upright ones
  // would be a second rectangular world, so one is asked for that has more lines.
  SceneDirectionOptions options;
  options.manhattan.min_evidence = 100;
  const Eigen::Vector3d level = R * Eigen::Vector3d(0.5, 0, 0.866).normalized(),
                        free = R * Eigen::Vector3d(1, 0.8, 1.2).normalized();
  int level_points = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    auto segments = test::manhattan_segments(camera, R, 60, 10, 0.3, random);
    test::add_edges(camera, level, 9, 0.3, random, segments);
    test::add_edges(camera, free, 25, 0.3, random, segments);
    const auto scene = find_scene_directions(segments, camera, options, random);
    ASSERT_EQ(scene.frames.size(), 1u) << seed;
    for (std::size_t i = 0; i < scene.roles.size(); ++i) {
      const PointRole role = scene.roles[i];
      if (role.across_axis < 0) continue;
      const Eigen::Vector3d v = scene.vanishing.points[i].direction;
      const Eigen::Vector3d axis =
          scene.frames[static_cast<std::size_t>(role.across_frame)].R_cam_manhattan.matrix().col(
              role.across_axis);
      EXPECT_LT(std::abs(v.dot(axis)), 0.02) << seed;
      level_points += std::abs(v.dot(level)) > 0.999;
      EXPECT_LT(std::abs(v.dot(free)), 0.999) << seed;
    }
  }
  EXPECT_GE(level_points, 36);
}

TEST(DirectionPrior, PullsToRightAnglesWhatIsNearThem) {
  DirectionPrior prior;
  prior.axes = {Eigen::Vector3d::UnitY()};
  prior.sigma_rad = 0.02;
  FittedDirection near;
  near.v = Eigen::Vector3d(0.6, std::sin(0.02), 0.8).normalized();
  near.covariance = 0.02 * 0.02 * (Eigen::Matrix3d::Identity() - near.v * near.v.transpose());
  FittedDirection pulled = near;
  prior.pull(pulled);
  ASSERT_EQ(pulled.across_axis, 0);
  EXPECT_NEAR(std::asin(pulled.v.y()), 0.01, 2e-4);
  EXPECT_NEAR(pulled.covariance(1, 1), 0.5 * near.covariance(1, 1), 1e-6);
  EXPECT_LT((pulled.covariance * pulled.v).norm(), 1e-12);
  EXPECT_LT(pulled.precision_cost, near.precision_cost);

  FittedDirection far = near;
  far.v = Eigen::Vector3d(0.6, 0.5, 0.8).normalized();
  pulled = far;
  prior.pull(pulled);
  ASSERT_EQ(pulled.across_axis, -1);
  EXPECT_EQ(pulled.v, far.v);
  EXPECT_EQ(pulled.covariance, far.covariance);
  EXPECT_NEAR(pulled.precision_cost - far.precision_cost, std::log(4.0), 1e-6);
}

TEST(DirectionPrior, KeepsDirectionsBeforeTheCamera) {
  DirectionPrior prior;
  prior.axes = {Eigen::Vector3d(0, 1, 1).normalized()};
  FittedDirection level;  // at the image plane's own angle: the pull takes it behind
  level.v = Eigen::Vector3d(0.999, 0.03, 0.001).normalized();
  level.covariance = 0.02 * 0.02 * (Eigen::Matrix3d::Identity() - level.v * level.v.transpose());
  prior.pull(level);
  ASSERT_EQ(level.across_axis, 0);
  EXPECT_GE(level.v.z(), 0);
}

TEST(DirectionPrior, WithoutAxesSaysNothing) {
  FittedDirection fit;
  DirectionPrior{}.pull(fit);
  EXPECT_EQ(fit.precision_cost, 0);
  EXPECT_EQ(fit.v, Eigen::Vector3d::UnitZ());
}

}  // namespace vanishing_points_test
}  // namespace placegraph
