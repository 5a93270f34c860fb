#include <gtest/gtest.h>
#include <placegraph/pipeline/local_map/local_map.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace local_map_test {

using namespace test;

/// A drive of which the map has keyframes, points and pixels without noise.
struct Drive {
  WindowWorld world;
  LocalMap map;

  explicit Drive(Scale scale, int keyframes = 8, int window = 10)
      : world(made(keyframes)), map(options(window), world.camera, scale) {}
  static WindowWorld made(int keyframes) {
    Random random(3);
    WindowWorldOptions o;
    o.keyframes = keyframes;
    return make_window_world(o, random);
  }
  static SlidingWindowOptions options(int window) {
    SlidingWindowOptions o;
    o.max_keyframes = window;
    return o;
  }
  void add(std::size_t k, double scale = 1) {
    const KeyframeId id = map.add_keyframe(world.T_map_cam[k].scaled(scale));
    for (const WindowObservation& o : world.observations) {
      if (o.keyframe != KeyframeId(k)) continue;
      WindowObservation of_map = o;
      of_map.keyframe = id;
      if (!map.window().landmark(o.landmark))
        map.window().add_landmark(
            o.landmark, scale * world.points[static_cast<std::size_t>(o.landmark.value())]);
      map.window().add_observation(of_map);
    }
    map.update_poses({4.0}, false);
  }
  void add_all(double scale = 1) {
    for (std::size_t k = 0; k < world.T_map_cam.size(); ++k) add(k, scale);
  }
};

/// Information of the motion from a keyframe to the next.
Matrix6d information_of(const LocalMap& map, KeyframeId id) {
  return map.information(map.link(id).motion);
}

TEST(LocalMap, NumbersKeyframesOverAllSegments) {
  Drive drive(Scale::kMetric);
  EXPECT_TRUE(drive.map.empty());
  drive.add(0);
  EXPECT_EQ(drive.map.before_newest(), std::nullopt);
  drive.add(1);
  EXPECT_EQ(drive.map.first(), KeyframeId(0));
  EXPECT_EQ(drive.map.newest(), KeyframeId(1));
  EXPECT_EQ(drive.map.before_newest(), KeyframeId(0));
  EXPECT_EQ(drive.map.window_begin(), KeyframeId(0));
  drive.map.restart(Scale::kMetric, std::nullopt);
  EXPECT_TRUE(drive.map.empty());
  EXPECT_EQ(drive.map.window_begin(), std::nullopt);
  drive.add(2);
  EXPECT_EQ(drive.map.first(), KeyframeId(2));
  EXPECT_EQ(drive.map.newest(), KeyframeId(2));
}

TEST(LocalMap, GoesOnFromAnotherRun) {
  Drive drive(Scale::kMetric);
  drive.map.go_on_from(KeyframeId(17), 3.5);
  EXPECT_EQ(drive.map.median_depth(), 3.5);
  drive.map.restart(Scale::kMetric, std::nullopt);
  EXPECT_EQ(drive.map.median_depth(), 3.5);
  EXPECT_EQ(drive.map.add_keyframe(SE3()), KeyframeId(17));
}

TEST(LocalMap, WhatIsDiscardedWasNeverThere) {
  Drive drive(Scale::kArbitrary);
  drive.map.restart(Scale::kArbitrary, 7.0);
  drive.add(0);
  drive.add(1);
  EXPECT_EQ(drive.map.median_depth(), 4);
  drive.map.discard(7.0);
  EXPECT_TRUE(drive.map.empty());
  EXPECT_EQ(drive.map.median_depth(), 7);
  EXPECT_TRUE(drive.map.landmarks().empty());
  EXPECT_TRUE(drive.map.window().keyframes().empty());
  EXPECT_EQ(drive.map.add_keyframe(SE3()), KeyframeId(0));
}

TEST(LocalMap, RescalingMovesTheSegmentAboutTheOldestKeyframe) {
  Drive drive(Scale::kArbitrary);
  drive.add_all(0.5);  // the true lengths are twice as long
  const SE3 first = drive.map.pose(KeyframeId(0)), last = drive.map.pose(drive.map.newest());
  const Rescale rescale = drive.map.rescale(2);
  EXPECT_TRUE(drive.map.metric());
  EXPECT_EQ(drive.map.median_depth(), 8);
  EXPECT_LT((rescale.centre_odom - first.translation()).norm(), 1e-12);
  EXPECT_LT(distance_m(drive.map.pose(KeyframeId(0)), first), 1e-12);
  const SE3 moved = drive.map.pose(drive.map.newest());
  EXPECT_LT(
      (moved.translation() - first.translation() - 2 * (last.translation() - first.translation()))
          .norm(),
      1e-12);
  EXPECT_LT(angle_rad(moved, last), 1e-12);
  for (const KeyframeId id : drive.map.window().keyframes())
    EXPECT_LT(distance_m(drive.map.pose(id), drive.map.window().pose(id)), 1e-12);
}

TEST(LocalMap, TheOldestKeyframeStaysInItsPlaceWhereverThatIs) {
  LocalMap map({}, window_camera(), Scale::kArbitrary);
  map.add_keyframe(SE3(SO3(), Eigen::Vector3d(5, 1, -2)));
  map.add_keyframe(SE3(SO3(), Eigen::Vector3d(5, 1, 0)));
  map.update_poses({}, false);
  (void)map.rescale(3);
  EXPECT_LT((map.pose(KeyframeId(0)).translation() - Eigen::Vector3d(5, 1, -2)).norm(), 1e-12);
  EXPECT_LT((map.pose(KeyframeId(1)).translation() - Eigen::Vector3d(5, 1, 4)).norm(), 1e-12);
}

TEST(LocalMap, LandmarksThatHaveLeftTheWindowAreRescaledWithTheirSegmentAlone) {
  Drive drive(Scale::kArbitrary, 8, 4);
  drive.add_all(0.5);
  drive.map.marginalize();
  const std::size_t settled = drive.map.settled_landmarks();
  ASSERT_GT(settled, 5u);
  const std::vector<PointLandmark> before = drive.map.landmarks();
  (void)drive.map.rescale(2);
  for (std::size_t i = 0; i < settled; ++i) {
    EXPECT_EQ(drive.map.landmarks()[i].id, before[i].id);
    EXPECT_LT((drive.map.landmarks()[i].point_cam - 2 * before[i].point_cam).norm(), 1e-12);
  }
  drive.map.restart(Scale::kArbitrary, std::nullopt);
  drive.add(0);
  drive.add(1);
  const PointLandmark old = drive.map.landmarks().front();
  (void)drive.map.rescale(3);
  EXPECT_EQ(drive.map.landmarks().front().point_cam, old.point_cam);
}

TEST(LocalMap, LandmarksStandWhereTheKeyframeThatFirstSawThemHasThem) {
  Drive drive(Scale::kMetric);
  drive.add_all();
  const auto all = drive.map.landmarks();
  ASSERT_FALSE(all.empty());
  for (const PointLandmark& landmark : all) {
    const Eigen::Vector3d there =
        drive.world.T_map_cam[static_cast<std::size_t>(landmark.keyframe.value())] *
        landmark.point_cam;
    EXPECT_LT((there - drive.world.points[static_cast<std::size_t>(landmark.id.value())]).norm(),
              1e-9);
    EXPECT_EQ(landmark.observations, 5);
  }
}

/// The observations of a drive by keyframe, ascending by landmark.
std::map<KeyframeId, std::map<LandmarkId, Eigen::Vector2f>> seen_in(
    const LocalMap& map, KeyframeId from = KeyframeId(0)) {
  std::map<KeyframeId, std::map<LandmarkId, Eigen::Vector2f>> seen;
  for (const auto& [keyframe, observations] : map.observations(from))
    for (const LandmarkObservation& o : observations) seen[keyframe][o.landmark] = o.px;
  return seen;
}

TEST(LocalMap, KeepsTheObservationsOfWhatLeavesTheWindow) {
  Drive drive(Scale::kMetric, 8, 4);
  drive.add_all();
  const auto before = seen_in(drive.map);
  EXPECT_EQ(before.size(), 8u);
  std::size_t count = 0;
  for (const auto& [keyframe, observations] : before) count += observations.size();
  EXPECT_EQ(count, drive.world.observations.size());
  drive.map.marginalize();
  EXPECT_EQ(drive.map.window().keyframes().size(), 4u);
  EXPECT_EQ(seen_in(drive.map), before);
  EXPECT_EQ(seen_in(drive.map, KeyframeId(6)).size(), 2u);
  // All of them are in the map.
  std::set<LandmarkId> landmarks;
  for (const PointLandmark& landmark : drive.map.landmarks()) landmarks.insert(landmark.id);
  for (const auto& [keyframe, observations] : before)
    for (const auto& [landmark, px] : observations) EXPECT_TRUE(landmarks.contains(landmark));
  drive.map.restart(Scale::kMetric, std::nullopt);
  EXPECT_EQ(seen_in(drive.map), before);
}

TEST(LocalMap, ForgetsTheObservationsOfADiscardedSegment) {
  Drive drive(Scale::kMetric, 8, 4);
  drive.add_all();
  drive.map.marginalize();
  drive.map.discard(4);
  EXPECT_TRUE(seen_in(drive.map).empty());
}

TEST(LocalMap, AFartherLandmarkIsLessCertain) {
  Drive drive(Scale::kMetric);
  drive.add_all();
  std::vector<std::pair<double, double>> depth_and_sigma;
  for (const PointLandmark& landmark : drive.map.landmarks()) {
    ASSERT_TRUE(landmark.covariance);
    const Eigen::Matrix3d& covariance = *landmark.covariance;
    EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-9));
    EXPECT_GT(covariance.determinant(), 0);
    // The direction of the ray is the least certain one.
    const Eigen::Vector3d ray = landmark.point_cam.normalized();
    EXPECT_GT(ray.dot(covariance * ray), covariance.trace() / 3);
    depth_and_sigma.emplace_back(landmark.point_cam.z(), std::sqrt(covariance.trace()));
  }
  std::ranges::sort(depth_and_sigma);
  const std::size_t third = depth_and_sigma.size() / 3;
  double near = 0, far = 0;
  for (std::size_t i = 0; i < third; ++i) {
    near += depth_and_sigma[i].second;
    far += depth_and_sigma[depth_and_sigma.size() - 1 - i].second;
  }
  EXPECT_LT(near, far);
}

TEST(LocalMap, LawTheCovarianceOfALandmarkDoesNotDependOnTheFrameOfTheMap) {
  Drive drive(Scale::kMetric), rotated(Scale::kMetric);
  const SE3 T_rotated_map = pose({0.4, -1.1, 0.7}, {3, 2, 1});
  for (SE3& T : rotated.world.T_map_cam) T = T_rotated_map * T;
  for (Eigen::Vector3d& p : rotated.world.points) p = T_rotated_map * p;
  drive.add_all();
  rotated.add_all();
  const auto all = drive.map.landmarks(), same = rotated.map.landmarks();
  ASSERT_EQ(all.size(), same.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_TRUE(all[i].covariance && same[i].covariance);
    EXPECT_TRUE(all[i].covariance->isApprox(*same[i].covariance, 1e-6)) << i;
  }
}

TEST(LocalMap, KeepsWhatIsKnownOfAMotionWhenItsKeyframeLeaves) {
  Drive drive(Scale::kMetric, 8, 4);
  drive.add_all();
  const AssessedMotion known = drive.map.motion(KeyframeId(0), KeyframeId(1));
  drive.map.marginalize();
  EXPECT_EQ(drive.map.window().keyframes().size(), 4u);
  const AssessedMotion kept = drive.map.link(KeyframeId(0)).motion;
  EXPECT_LT((kept.by_observations - known.by_observations).norm(),
            1e-6 * known.by_observations.norm());
  EXPECT_LT((kept.by_imaging_errors - known.by_imaging_errors).norm(),
            1e-6 * known.by_imaging_errors.norm());
  EXPECT_EQ(drive.map.link(KeyframeId(0)).sigma_log_scale, 0);
  EXPECT_NO_THROW(drive.map.pose(KeyframeId(0)));
}

TEST(LocalMap, WhereTheScaleIsArbitraryALengthIsKnownInTheUnitOfItsKeyframe) {
  Drive drive(Scale::kArbitrary);
  drive.add_all();
  const LocalMap::Link link = drive.map.link(KeyframeId(2));
  EXPECT_GT(link.sigma_log_scale, 0);
  EXPECT_LE(link.sigma_log_scale, 0.1);
  const SE3 motion = drive.map.pose(KeyframeId(2)).inverse() * drive.map.pose(KeyframeId(3));
  const Eigen::Vector3d t = motion.translation();
  const Eigen::Vector3d along = motion.rotation().inverse() * t.normalized();
  const double sigma = std::max(1e-3, link.sigma_log_scale) * t.norm();
  EXPECT_GE(along.dot(information_of(drive.map, KeyframeId(2)).topLeftCorner<3, 3>() * along), 0.999 / (sigma * sigma));
  drive.map.set_scale(Scale::kMetric);
  EXPECT_EQ(drive.map.link(KeyframeId(2)).sigma_log_scale, 0);
}

TEST(LocalMap, ARotationThatIsCorrectedWidensTheLinkToTheKeyframeThatLeftBefore) {
  Drive drive(Scale::kMetric, 8, 4);
  drive.add_all();
  drive.map.marginalize();  // keyframes 4 to 7 are left
  const Matrix6d before = information_of(drive.map, KeyframeId(3));
  drive.map.update_poses({}, true);  // nothing was rotated
  EXPECT_LT((information_of(drive.map, KeyframeId(3)) - before).norm(), 1e-9 * before.norm());
  // A prior rotates the whole window by 0.02 rad about y.
  const Eigen::Vector3d step_rotation(0, 0.02, 0);
  for (const KeyframeId id : drive.map.window().keyframes()) {
    const SE3 T = drive.map.window().pose(id);
    const SE3 target(T.rotation() * SO3::exp(step_rotation), T.translation());
    add_pose_prior(drive.map.window(), {id, target, 1e9 * Matrix6d::Identity()});
  }
  ASSERT_TRUE(drive.map.optimize());
  const double rotated =
      angle_rad(drive.map.window().pose(KeyframeId(4)), drive.map.pose(KeyframeId(4)));
  ASSERT_GT(rotated, 1e-4);
  drive.map.update_poses({}, true);
  const Matrix6d after = information_of(drive.map, KeyframeId(3));
  EXPECT_LT(after(4, 4), 1.01 / (rotated * rotated));  // its variance is the rotation's square
  EXPECT_LT(after(4, 4), before(4, 4));
}

TEST(LocalMap, LawTheUnitOfLengthChangesNoRotationAndNoRelativeInformation) {
  Drive one(Scale::kArbitrary), three(Scale::kArbitrary);
  one.add_all(1);
  three.add_all(3);
  const Matrix6d a = information_of(one.map, KeyframeId(3)),
                 b = information_of(three.map, KeyframeId(3));
  const Eigen::Matrix3d a_t = a.topLeftCorner<3, 3>(), b_t = b.topLeftCorner<3, 3>();
  const Eigen::Matrix3d a_r = a.bottomRightCorner<3, 3>(), b_r = b.bottomRightCorner<3, 3>();
  // Translations are three times as long, and known three times worse.
  EXPECT_LT((a_t - 9 * b_t).norm(), 1e-4 * a_t.norm());
  EXPECT_LT((a_r - b_r).norm(), 1e-4 * a_r.norm());
}

}  // namespace local_map_test
}  // namespace placegraph
