#include <gtest/gtest.h>
#include <placegraph/frontend/lines/vanishing_direction_tracker.h>

#include "tests/support/scenes/room_lines.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace vanishing_direction_tracker_test {

using namespace test;

TEST(VanishingDirectionTracker, ReadsTheRotationByTracksWhoseDirectionItLearned) {
  Random random = seeded_random(61);
  const LineScene scene = corridor_lines();
  VanishingDirectionTracker tracker{VanishingPointOptions{}};
  tracker.learn(scene.camera, view_of(scene, SE3(), 0.05, random), SO3(), random);
  EXPECT_EQ(tracker.directions(), 3);
  const SE3 T(SO3::exp({0.02, -0.15, 0.01}), Eigen::Vector3d(0.2, 0, 0.5));
  const auto heading = tracker.read(scene.camera, view_of(scene, T, 0.05, random),
                                    T.rotation() * SO3::exp({0.01, 0.01, -0.01}), 0.05);
  ASSERT_TRUE(heading.outcome) << heading.outcome.reason;
  EXPECT_GE(heading.lines, 12);
  const Eigen::Vector3d error = (heading.R_ref_cam.inverse() * T.rotation()).log();
  EXPECT_LT(error.norm(), 4e-3);
  EXPECT_LT(error.dot(heading.information * error), 16.3) << "chi2 of three, one in a thousand";
}

TEST(VanishingDirectionTracker, NamesTheDirectionsInViewAndTheirTracks) {
  Random random = seeded_random(64);
  const LineScene scene = corridor_lines();
  VanishingDirectionTracker tracker{VanishingPointOptions{}};
  EXPECT_TRUE(tracker.clusters().empty());
  tracker.learn(scene.camera, view_of(scene, SE3(), 0.05, random), SO3(), random);
  const auto clusters = tracker.clusters();
  ASSERT_EQ(clusters.size(), 3u);
  for (const auto& cluster : clusters) {
    EXPECT_GE(cluster.tracks.size(), 3u);
    EXPECT_GT(cluster.d_ref.cwiseAbs().maxCoeff(), std::cos(5 * cluster.sigma_rad));
    EXPECT_LT(cluster.sigma_rad, 0.02);
    for (const LineId id : cluster.tracks) {
      const auto i = static_cast<std::size_t>(id.value());
      EXPECT_GT(std::abs((scene.to[i] - scene.from[i]).normalized().dot(cluster.d_ref)), 0.99)
          << id;
    }
  }
}

TEST(VanishingDirectionTracker, SaysNothingWithoutTracksThatItKnows) {
  Random random = seeded_random(62);
  const LineScene scene = corridor_lines();
  const VanishingDirectionTracker tracker{VanishingPointOptions{}};
  const auto heading = tracker.read(scene.camera, view_of(scene, SE3(), 0.05, random), SO3(), 0.1);
  EXPECT_EQ(heading.outcome.code, Outcome::Code::kTooFewData);
}

TEST(VanishingDirectionTracker, OfOneDirectionLeavesTheRotationAboutItOpen) {
  Random random = seeded_random(63);
  LineScene scene;
  for (int i = 0; i < 12; ++i) {  // uprights
    const double x = -2 + 0.35 * i;
    scene.from.emplace_back(x, -1, 5 + 0.2 * (i % 3));
    scene.to.emplace_back(x, 1, 5 + 0.2 * (i % 3));
  }
  VanishingDirectionTracker tracker{VanishingPointOptions{}};
  const LineView view = view_of(scene, SE3(), 0.05, random);
  tracker.learn(scene.camera, view, SO3(), random);
  ASSERT_EQ(tracker.directions(), 1);
  const auto heading = tracker.read(scene.camera, view, SO3(), 0.1);
  ASSERT_TRUE(heading.outcome);
  const double about = heading.information(1, 1), across = heading.information(0, 0);
  EXPECT_LT(about, 1e-3 * across);
}

}  // namespace vanishing_direction_tracker_test
}  // namespace placegraph
