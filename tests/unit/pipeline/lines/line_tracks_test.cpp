#include <gtest/gtest.h>
#include <placegraph/pipeline/lines/line_tracks.h>

#include "tests/unit/pipeline/lines/edge_tracks.h"

namespace placegraph {
namespace line_tracks_test {

using namespace test;

using Eigen::Vector3d;

/// Three upright edges, seen from a pose that is not the origin: 1 and 2 are lines of the window,
/// 2 beside where it is seen, 3 is none.
struct Tracks {
  SE3 T_odom_cam{SO3::exp({0.03, -0.04, 0.02}), Vector3d(0.2, -0.1, -1)};
  SlidingWindow window{{}, line_camera()};
  std::vector<LineTrack> tracks;
  static Vector3d top(int i) { return {0.4 * i - 0.8, -1, 3.0 + i}; }
  static Vector3d bottom(int i) { return {0.4 * i - 0.8, 1, 3.0 + i}; }
  Tracks() {
    window.add_keyframe(KeyframeId(0), T_odom_cam);
    for (int i = 1; i <= 3; ++i)
      tracks.push_back(track_of(LineId(i), T_odom_cam, top(i), bottom(i)));
    window.add_line(LineId(1), line_through(top(1), bottom(1)));
    window.add_line(LineId(2),
                    line_through(top(2) + Vector3d(0.01, 0, 0), bottom(2) + Vector3d(0.01, 0, 0)));
  }
};

TEST(LineTracks, TheViewHoldsAllTracksAndNoCarrierIsKnownBetterThanTheFloor) {
  const Tracks t;
  const LineView view = line_view(t.tracks, 0.5);
  ASSERT_EQ(view.size(), 3u);
  EXPECT_EQ(view.at(LineId(3)).segment.start, t.tracks[2].edge.segment.start);
  EXPECT_GE(view.at(LineId(3)).seen.sigma_px, 0.5);
  EXPECT_LT(line_view(t.tracks, 0).at(LineId(3)).seen.sigma_px, 0.5);
}

TEST(LineTracks, TracksThatAreLinesOfTheWindowAreCounted) {
  const Tracks t;
  EXPECT_EQ(count_lines(t.tracks, t.window), 2);
}

TEST(LineTracks, DepthsAreThoseInTheNewestImage) {
  const Tracks t;
  const auto depths = depths_of_lines(line_camera(), {t.tracks[0]}, t.window, t.T_odom_cam);
  ASSERT_EQ(depths.size(), 1u);
  const Vector3d top = t.T_odom_cam.inverse() * Tracks::top(1);
  const Vector3d bottom = t.T_odom_cam.inverse() * Tracks::bottom(1);
  // The middle in the image lies between both ends, at the harmonic mean of their depths.
  EXPECT_NEAR(depths[0], 2 / (1 / top.z() + 1 / bottom.z()), 1e-6);
  EXPECT_EQ(depths_of_lines(line_camera(), t.tracks, t.window, t.T_odom_cam).size(), 2u);
}

TEST(LineTracks, LinesBehindTheCameraHaveNoDepth) {
  const Tracks t;
  const SE3 beyond(SO3(), Vector3d(0, 0, 50));
  EXPECT_TRUE(depths_of_lines(line_camera(), t.tracks, t.window, beyond).empty());
}

TEST(LineTracks, WhatIsDrawnHoldsTheResidualsOfLinesOfTheWindow) {
  const Tracks t;
  const auto view = view_of_lines(line_camera(), t.tracks, t.window, t.T_odom_cam);
  ASSERT_EQ(view.size(), 3u);
  EXPECT_NEAR(*view[0].off_px, 0, 1e-6);
  EXPECT_NEAR(*view[1].off_px, 500 * 0.01 / 6, 0.2);  // a centimetre, six metres ahead
  EXPECT_FALSE(view[2].off_px);
}

TEST(LineTracks, FeaturesHoldTheLineInTheCameraFrame) {
  const Tracks t;
  const auto features = features_of_lines(line_camera(), t.tracks, t.window, t.T_odom_cam);
  ASSERT_EQ(features.size(), 3u);
  ASSERT_TRUE(features[0].line_cam);
  const Vector3d top_cam = t.T_odom_cam.inverse() * Tracks::top(1);
  const Vector3d bottom_cam = t.T_odom_cam.inverse() * Tracks::bottom(1);
  const Line3 wanted = line_through(top_cam, bottom_cam);
  EXPECT_NEAR(features[0].line_cam->distance_to(top_cam), 0, 1e-9);
  EXPECT_NEAR(features[0].line_cam->distance_to(bottom_cam), 0, 1e-9);
  EXPECT_NEAR(features[0].line_cam->direction().cross(wanted.direction()).norm(), 0, 1e-9);
  EXPECT_FALSE(features[2].line_cam);
}

TEST(LineTracks, EdgesThatLeaveTheImageAreNoFeatures) {
  Tracks t;
  t.tracks[0].edge.segment.end.x() = 641;
  EXPECT_EQ(features_of_lines(line_camera(), t.tracks, t.window, t.T_odom_cam).size(), 2u);
}

}  // namespace line_tracks_test
}  // namespace placegraph
