#include <gtest/gtest.h>
#include <placegraph/pipeline/local_map/lens_stretches.h>
#include <placegraph/pipeline/tracking/intermediate_frames.h>
#include <placegraph/pipeline/tracking/keyframe_selector.h>

#include "tests/support/scenes/window_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace tracking_test {

using namespace test;

constexpr int kTrials = 30;

SE3 anywhere(Random& random) { return random_motion(random, 5, 0.8); }

// IntermediateFrames ------------------------------------------------------------------------------

/// A map of two keyframes with landmarks, and frames between them that see some of those.
struct Between {
  Camera camera = window_camera();
  std::vector<Eigen::Vector3d> points;
  std::vector<SE3> T_keyframe_cam;  ///< truth
  std::vector<std::vector<std::pair<LandmarkId, Eigen::Vector2d>>> px;
  std::vector<SE3> thought;  ///< T_keyframe_cam as it was tracked

  explicit Between(Random& random) {
    for (int i = 0; i < 50; ++i)
      points.emplace_back(random.uniform(-3, 3), random.uniform(-1, 1), random.uniform(6, 15));
    for (int f = 0; f < 3; ++f) {
      T_keyframe_cam.push_back(pose({0.01 * random.normal(), 0.02 * f, 0}, {0.1 * f, 0, 0.3 * f}));
      thought.push_back(T_keyframe_cam.back() * random_motion(random, 0.05, 0.005));
      px.emplace_back();
      for (std::size_t i = 0; i < points.size(); ++i)
        px.back().emplace_back(LandmarkId(i),
                               *camera.project(T_keyframe_cam.back().inverse() * points[i]) +
                                   0.3 * Eigen::Vector2d(random.normal(), random.normal()));
    }
  }
  /// Poses of the frames where the keyframe stands at T_odom_keyframe and lengths have grown by
  /// `grown` since they were tracked.
  std::vector<std::pair<FrameId, SE3>> repose(const SE3& T_odom_keyframe, double grown = 1) const {
    LocalMap map({}, camera, Scale::kArbitrary);
    map.add_keyframe(T_odom_keyframe);
    map.add_keyframe(T_odom_keyframe * pose({0, 0, 0}, {0, 0, 1}));
    for (std::size_t i = 0; i < points.size(); ++i)
      map.window().add_landmark(LandmarkId(i), T_odom_keyframe * (grown * points[i]));
    IntermediateFrames frames({}, camera);
    for (std::size_t f = 0; f < px.size(); ++f)
      frames.remember({FrameId(f), thought[f], px[f], std::nullopt});
    return frames.repose(map, KeyframeId(0), grown);
  }
};

TEST(IntermediateFramesLaws, MoveWithTheWorld) {
  Random random = seeded_random(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Between between(random);
    const SE3 T_other = anywhere(random);
    const auto here = between.repose(SE3()), there = between.repose(T_other);
    ASSERT_EQ(here.size(), 3u);
    ASSERT_EQ(there.size(), 3u);
    for (std::size_t f = 0; f < 3; ++f) {
      EXPECT_EQ(here[f].first, there[f].first);
      EXPECT_LT(((T_other * here[f].second).inverse() * there[f].second).log().norm(), 1e-5) << f;
      // Fifty pixels of 0.3 px at 718 px focal length and ten metres.
      EXPECT_LT((here[f].second.inverse() * between.T_keyframe_cam[f]).log().norm(), 0.02) << f;
    }
  }
}

TEST(IntermediateFramesLaws, GrowWithTheMap) {
  Random random = seeded_random(2);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Between between(random);
    const double grown = random.uniform(0.1, 10);
    const auto before = between.repose(SE3()), after = between.repose(SE3(), grown);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t f = 0; f < before.size(); ++f) {
      EXPECT_LT(angle_rad(before[f].second, after[f].second), 1e-5) << f;
      EXPECT_LT((grown * before[f].second.translation() - after[f].second.translation()).norm(),
                1e-4 * grown)
          << f;
    }
  }
}

// KeyframeSelector --------------------------------------------------------------------------------

/// Tracks of points, as cameras at `T_world_cam` see them.
std::vector<PointTrack> tracks_of(const std::vector<Eigen::Vector3d>& points,
                                  const SE3& T_world_cam) {
  std::vector<PointTrack> tracks;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const auto px = window_camera().project(T_world_cam.inverse() * points[i])) {
      PointTrack track;
      track.id = LandmarkId(i);
      track.px = px->cast<float>();
      tracks.push_back(track);
    }
  return tracks;
}
std::vector<Eigen::Vector3d> points_ahead(Random& random) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40; ++i)
    points.emplace_back(random.uniform(-4, 4), random.uniform(-1.5, 1.5), random.uniform(6, 20));
  return points;
}
std::vector<double> flow(const KeyframeOptions& options, const std::vector<PointTrack>& from,
                         const std::vector<PointTrack>& to, const SO3& R_from_to) {
  KeyframeSelector selector(options, window_camera(), 12);
  selector.start(from, 40);
  return selector.flow_px(to, R_from_to);
}

TEST(KeyframeSelectorLaws, BackwardsTracksMoveAsFar) {
  Random random = seeded_random(3);
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto points = points_ahead(random);
    const SE3 motion = pose({0, 0.01 * random.normal(), 0}, {0.2 * random.normal(), 0, 0.3});
    const auto a = tracks_of(points, SE3()), b = tracks_of(points, motion);
    const auto there = flow({}, a, b, motion.rotation()),
               back = flow({}, b, a, motion.inverse().rotation());
    ASSERT_EQ(there.size(), back.size());
    for (std::size_t i = 0; i < there.size(); ++i) EXPECT_NEAR(there[i], back[i], 1e-3);
  }
}

TEST(KeyframeSelectorLaws, ARotationIsNoParallax) {
  Random random = seeded_random(4);
  KeyframeOptions parallax;
  parallax.derotated = true;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto points = points_ahead(random);
    const SO3 R =
        SO3::exp({0.02 * random.normal(), 0.05 * random.normal(), 0.02 * random.normal()});
    const SE3 step = pose({0, 0, 0}, {0.3, 0, 0});
    const auto first = tracks_of(points, SE3());
    // While it rotates in place nothing moves.
    for (const double px : flow(parallax, first, tracks_of(points, SE3(R, {0, 0, 0})), R))
      EXPECT_LT(px, 0.01);
    // On its way the parallax is that of the way alone.
    const auto straight = flow(parallax, first, tracks_of(points, step), SO3()),
               rotated = flow(parallax, first, tracks_of(points, step * SE3(R, {0, 0, 0})), R);
    ASSERT_EQ(straight.size(), rotated.size());
    for (std::size_t i = 0; i < straight.size(); ++i) EXPECT_NEAR(straight[i], rotated[i], 0.05);
  }
}

// LensStretches -----------------------------------------------------------------------------------

TEST(LensStretchesLaws, TheOrderOfStretchesDoesNotMatter) {
  Random random = seeded_random(5);
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<DistortionEvidence> windows;
    for (int i = 0; i < 8; ++i) {
      const double information = random.uniform(1e4, 1e6);
      windows.push_back({information * random.normal(0.01, 0.003), information, 500});
    }
    LensStretches forwards, backwards;
    for (const DistortionEvidence& window : windows) forwards.add(window);
    std::reverse(windows.begin(), windows.end());
    for (const DistortionEvidence& window : windows) backwards.add(window);
    const LensDistortion a = forwards.estimate(), b = backwards.estimate();
    EXPECT_NEAR(a.k1, b.k1, 1e-12);
    EXPECT_NEAR(a.effect, b.effect, 1e-12);
    EXPECT_NEAR(a.sigma_k1, b.sigma_k1, 1e-12);
    EXPECT_NEAR(a.stretches, b.stretches, 1e-9);
  }
}

TEST(LensStretchesLaws, TheDeviationIsThatOfTheMean) {
  Random random = seeded_random(6);
  constexpr double kTruth = 0.02, kSigma = 0.02;
  double squared = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    LensStretches lens;
    for (int window = 0; window < 12; ++window) {
      const double information = 1 / (kSigma * kSigma);
      lens.add({-information * random.normal(kTruth, kSigma), information, 500});
    }
    const double off = (lens.estimate().k1 - kTruth) / lens.estimate().sigma_k1;
    squared += off * off / kRuns;
  }
  // It takes no less than the stretches claim, and adds an error that they share, so that it errs a
  // little on the safe side.
  EXPECT_GT(squared, 0.6);
  EXPECT_LT(squared, 1.2);
}

}  // namespace tracking_test
}  // namespace placegraph
