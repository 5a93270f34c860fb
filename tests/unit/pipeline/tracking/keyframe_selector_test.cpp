#include <gtest/gtest.h>
#include <placegraph/pipeline/tracking/keyframe_selector.h>

namespace placegraph {
namespace keyframe_selector_test {

Camera camera() {
  return {.width = 400, .height = 300, .fx = 300, .fy = 300, .cx = 199.5, .cy = 149.5};
}

/// A grid of tracks; `moved` tells where each stands now.
template <class Move>
std::vector<PointTrack> tracks(const Move& moved) {
  std::vector<PointTrack> all;
  for (int i = 0; i < 30; ++i) {
    PointTrack track;
    track.id = LandmarkId(i);
    track.px = moved(Eigen::Vector2f(60.f + 50.f * static_cast<float>(i % 6),
                                     60.f + 40.f * static_cast<float>(i / 6)));
    all.push_back(track);
  }
  return all;
}
std::vector<PointTrack> shifted(float dx) {
  return tracks([&](const Eigen::Vector2f& px) { return Eigen::Vector2f(px.x() + dx, px.y()); });
}

KeyframeOptions options() {
  KeyframeOptions o;
  o.max_flow_share = 0.05;  // 20 px
  o.min_tracked_share = 0.7;
  o.max_interval = 3;
  return o;
}

/// After a keyframe with 100 landmarks.
KeyframeSelector selector(const KeyframeOptions& o = options()) {
  KeyframeSelector s(o, camera(), 12);
  s.start(shifted(0), 100);
  return s;
}
KeyframeSelector::Overlap overlap(const KeyframeSelector& s, float dx, int inliers = 100) {
  return {inliers, false, s.flow_px(shifted(dx), SO3())};
}

TEST(KeyframeSelector, AsksForAKeyframeOnceTheImageHasMovedFarEnough) {
  const KeyframeSelector s = selector();
  EXPECT_FALSE(s.due(overlap(s, 19)));
  EXPECT_TRUE(s.due(overlap(s, 21)));
}

TEST(KeyframeSelector, AsksForAKeyframeOnceTooManyLandmarksAreLost) {
  const KeyframeSelector s = selector();
  EXPECT_FALSE(s.due(overlap(s, 1, 70)));
  EXPECT_TRUE(s.due(overlap(s, 1, 69)));
}

TEST(KeyframeSelector, BeforeTooFewLandmarksAreLeftOtherTracksShallBecomeSome) {
  KeyframeSelector s = selector();
  s.start(shifted(0), 20);
  KeyframeSelector::Overlap few = overlap(s, 1, 23);  // 12 are needed to pose a frame
  EXPECT_FALSE(s.due(few));
  few.more_tracks = true;
  EXPECT_TRUE(s.due(few));
  few.inliers = 24;
  EXPECT_FALSE(s.due(few));
}

TEST(KeyframeSelector, AsksForAKeyframeWhereTooFewTracksTellTheMotion) {
  const KeyframeSelector s = selector();
  EXPECT_TRUE(s.due({100, false, std::vector<double>(9, 1.0)}));
  EXPECT_FALSE(s.due({100, false, std::vector<double>(10, 1.0)}));
}

TEST(KeyframeSelector, AsksForAKeyframeAfterTheIntervalOnlyIfTheCameraMoves) {
  KeyframeSelector s = selector();
  for (int i = 0; i < 2; ++i) s.count_frame();
  EXPECT_FALSE(s.due(overlap(s, 3)));
  s.count_frame();
  EXPECT_EQ(s.frames(), 3);
  EXPECT_TRUE(s.due(overlap(s, 3)));   // a tenth of 20 px is exceeded
  EXPECT_FALSE(s.due(overlap(s, 1)));  // it stands
}

TEST(KeyframeSelector, CountsFramesFromTheLastKeyframeOn) {
  KeyframeSelector s = selector();
  s.count_frame();
  s.start(shifted(5), 50);
  EXPECT_EQ(s.frames(), 0);
  EXPECT_EQ(s.px_at_keyframe().at(LandmarkId(0)), Eigen::Vector2d(65, 60));
  s.reset();
  EXPECT_TRUE(s.px_at_keyframe().empty());
  EXPECT_TRUE(s.flow_px(shifted(0), SO3()).empty());
}

TEST(KeyframeSelector, TracksThatBeganAfterTheKeyframeHaveNoDisplacement) {
  const KeyframeSelector s = selector();
  std::vector<PointTrack> now = shifted(4);
  for (PointTrack& track : now)
    track.id = LandmarkId(track.id.value() + 10);  // twenty of them are known
  const std::vector<double> flow_px = s.flow_px(now, SO3());
  EXPECT_EQ(flow_px.size(), 20u);
}

TEST(KeyframeSelector, DerotatedDisplacementsOfAPureRotationVanish) {
  KeyframeOptions o = options();
  o.derotated = true;
  const KeyframeSelector s = selector(o);
  const SO3 R_keyframe_cam = SO3::exp({0.02, -0.05, 0.03});
  const std::vector<PointTrack> rotated = tracks([&](const Eigen::Vector2f& px) {
    const Eigen::Vector3d ray = *camera().unproject(px.cast<double>());
    return camera().project(R_keyframe_cam.inverse() * ray)->cast<float>().eval();
  });
  for (const double px : s.flow_px(rotated, R_keyframe_cam)) EXPECT_LT(px, 1e-3);
  const KeyframeSelector plain = selector();
  for (const double px : plain.flow_px(rotated, R_keyframe_cam)) EXPECT_GT(px, 5);
  for (const double px : s.flow_px(rotated, R_keyframe_cam.inverse())) EXPECT_GT(px, 5);
}

}  // namespace keyframe_selector_test
}  // namespace placegraph
