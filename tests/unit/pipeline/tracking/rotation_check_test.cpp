#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/pipeline/cues/determined_rotation.h>
#include <placegraph/pipeline/tracking/rotation_check.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace rotation_check_test {

using namespace test;

const Camera kCamera = pinhole(640, 480, 500);

std::vector<PointTrack> tracks_of(const PointScene& scene) {
  std::vector<PointTrack> tracks(scene.px[0].size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    tracks[i].id = LandmarkId(static_cast<std::int64_t>(i));
    tracks[i].px_previous = scene.px[0][i].cast<float>();
    tracks[i].px = scene.px[1][i].cast<float>();
  }
  return tracks;
}

/// A step of a walk; every fifth track slides along something that moves.
struct Step {
  SE3 truth = pose({0.01, 0.06, 0}, {0.12, 0.02, 0.1});
  Random random;
  PointScene scene;
  explicit Step(std::uint64_t seed, int points = 200) : random(seeded_random(seed)) {
    scene = make_scene(kCamera, {SE3(), truth}, points, random,
                       [&](const auto&) { return random.uniform(1.5, 6); });
    disturb();
  }
  void disturb() {
    for (auto& px : scene.px) add_noise(px, 0.2, random);
    for (std::size_t i = 0; i < scene.px[1].size(); i += 5)
      scene.px[1][i] += Eigen::Vector2d(4, random.uniform(3, 6));
  }
  bool contradicts(const SE3& T_previous_this) {
    return contradicts_rotation(kCamera, tracks_of(scene), T_previous_this, {}, random);
  }
};

TEST(RotationCheck, TheRightRotationIsNotContradictedInAnyScale) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Step step(seed);
    EXPECT_FALSE(step.contradicts(step.truth)) << seed;
    EXPECT_FALSE(step.contradicts(step.truth.scaled(7))) << seed;
    // A direction that is off by some degrees is no rotation.
    EXPECT_FALSE(step.contradicts(step.truth * pose({0, 0, 0}, {0.01, -0.01, 0}))) << seed;
  }
}

TEST(RotationCheck, AWrongRotationIsContradicted) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Step step(seed);
    EXPECT_TRUE(step.contradicts(step.truth * pose({0, 0.05, 0}, {0, 0, 0}))) << seed;
    EXPECT_TRUE(step.contradicts(step.truth * pose({0.03, 0, 0.03}, {0, 0, 0}))) << seed;
    EXPECT_TRUE(step.contradicts(step.truth * pose({0, 0.2, 0}, {0.1, 0, 0}))) << seed;
  }
}

TEST(RotationCheck, APlaneDoesNotContradictTheRotationBeforeIt) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Step step(seed);
    step.scene = make_scene(kCamera, {SE3(), step.truth}, 200, step.random,
                            [](const Eigen::Vector3d& ray) { return 3 / (1 + 0.4 * ray.x()); });
    step.disturb();
    EXPECT_FALSE(step.contradicts(step.truth)) << seed;
  }
}

TEST(RotationCheck, FewTracksContradictNothing) {
  Step step(3, 25);
  EXPECT_FALSE(step.contradicts(step.truth * pose({0, 0.2, 0}, {0, 0, 0})));
}

/// Information of a pose from `count` points around a ray, within `width` of it.
Matrix6d information_of(int count, double width) {
  Random random = seeded_random(5);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d ray(0.2 + random.uniform(-width, width), random.uniform(-width, width),
                              1);
    points.push_back(random.uniform(3, 3.3) * ray);
    px.push_back(*kCamera.project(points.back()));
  }
  const auto posed = estimate_pose_3d2d(kCamera, points, px, {}, random);
  EXPECT_TRUE(posed.outcome);
  return posed.information;
}

TEST(RotationCheck, PointsInASmallPartOfTheImageLeaveTheRotationOpen) {
  EXPECT_TRUE(determines_rotation(information_of(200, 0.4), 0.5));
  EXPECT_TRUE(determines_rotation(information_of(15, 0.4), 0.5));
  const Outcome open = determines_rotation(information_of(15, 0.02), 0.5);
  EXPECT_EQ(open.code, Outcome::Code::kDegenerate);
  EXPECT_NE(open.reason.find("degrees only"), std::string::npos) << open.reason;
  EXPECT_EQ(determines_rotation(Matrix6d::Zero(), 0.5).reason,
            "the points do not determine the rotation");
}

}  // namespace rotation_check_test
}  // namespace placegraph
