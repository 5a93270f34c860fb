#include <gtest/gtest.h>
#include <placegraph/pipeline/lines/line_prediction.h>

#include "tests/unit/pipeline/lines/edge_tracks.h"

namespace placegraph {
namespace line_prediction_test {

using namespace test;

using Eigen::Vector2d;
using Eigen::Vector3d;

/// An upright edge 4 m ahead, seen from the origin, and the pose the camera moves to.
const Vector3d kTop(0.5, -1, 4), kBottom(0.5, 1, 4);
const SE3 kMoved(SO3::exp({0.02, -0.05, 0.01}), Vector3d(0.3, 0.1, 0.4));

TEST(LinePrediction, ASegmentMovesAsItsEndsDo) {
  const LineTrack track = track_of(LineId(7), SE3(), kTop, kBottom + Vector3d(0, 0, 2));
  const LineSegment moved =
      moved_segment(line_camera(), track.edge.segment, {4, 6}, kMoved.inverse(), 4);
  EXPECT_NEAR((moved.start - project(kMoved, kTop)).norm(), 0, 1e-9);
  EXPECT_NEAR((moved.end - project(kMoved, kBottom + Vector3d(0, 0, 2))).norm(), 0, 1e-9);
}

TEST(LinePrediction, WhatComesTooNearIsCutOffOnItsLine) {
  // The camera goes 3.9 m ahead: of a segment from 4 m to 8 m, 0.1 m to 4.1 m are before it.
  const Vector3d near(1, 0.5, 4), far(1, 0.5, 8);
  const LineTrack track = track_of(LineId(7), SE3(), near, far);
  const SE3 T_odom_cam(SO3(), Vector3d(0, 0, 3.9));
  const LineSegment moved =
      moved_segment(line_camera(), track.edge.segment, {4, 8}, T_odom_cam.inverse(), 6);
  EXPECT_NEAR((moved.start - project(T_odom_cam, Vector3d(1, 0.5, 3.9 + 0.05 * 6))).norm(), 0,
              1e-6);
  EXPECT_NEAR((moved.end - project(T_odom_cam, far)).norm(), 0, 1e-9);
}

TEST(LinePrediction, ASegmentBehindTheCameraHasNoLength) {
  const LineTrack track = track_of(LineId(7), SE3(), kTop, kBottom);
  const SE3 T_odom_cam(SO3(), Vector3d(0, 0, 5));
  EXPECT_EQ(
      moved_segment(line_camera(), track.edge.segment, {4, 4}, T_odom_cam.inverse(), 4).length(),
      0);
}

TEST(LinePrediction, LinesOfTheWindowTellThreeDepthsEach) {
  SlidingWindow window({}, line_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_line(LineId(7), line_through(kTop, kBottom + Vector3d(0, 0, 2)));
  const std::vector<LineTrack> tracks = {
      track_of(LineId(7), SE3(), kTop, kBottom + Vector3d(0, 0, 2)),
      track_of(LineId(8), SE3(), kTop, kBottom)};
  const auto known = known_depths(line_camera(), tracks, window, SE3());
  ASSERT_EQ(known.size(), 3u);
  EXPECT_NEAR(known[0].depth, 4, 1e-9);
  EXPECT_NEAR(known[2].depth, 6, 1e-9);
  EXPECT_NEAR(known[0].px.x(), tracks[0].edge.segment.start.x(), 1e-3);
  // Seen from half a metre behind, the line is half a metre deeper.
  const SE3 behind(SO3(), Vector3d(0, 0, -0.5));
  const auto deeper =
      known_depths(line_camera(), {track_of(LineId(7), behind, kTop, kBottom + Vector3d(0, 0, 2))},
                   window, behind);
  ASSERT_EQ(deeper.size(), 3u);
  EXPECT_NEAR(deeper[0].depth, 4.5, 1e-9);
}

TEST(LinePrediction, ALineOfTheWindowIsExpectedWhereItIsSeenNext) {
  SlidingWindow window({}, line_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  const Vector3d end = kBottom + Vector3d(0, 0, 2);
  window.add_line(LineId(7), line_through(kTop, end));
  const std::map<LineId, double> drift_px = {{LineId(7), 3}};  // does not count: its place is known
  const auto expected = predict_segments(line_camera(), {track_of(LineId(7), SE3(), kTop, end)},
                                         window, {SE3(), kMoved, 20}, drift_px);
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_NEAR((expected[0].start - project(kMoved, kTop)).norm(), 0, 1e-9);
  EXPECT_NEAR((expected[0].end - project(kMoved, end)).norm(), 0, 1e-9);
}

TEST(LinePrediction, OtherTracksLieAsDeepAsTheLinesBesideThem) {
  SlidingWindow window({}, line_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_line(LineId(7), line_through(kTop, kBottom));
  const Vector3d beside(0.1, 0, 0);
  const std::map<LineId, double> drift_px;
  const auto expected =
      predict_segments(line_camera(),
                       {track_of(LineId(7), SE3(), kTop, kBottom),
                        track_of(LineId(8), SE3(), kTop + beside, kBottom + beside)},
                       window, {SE3(), kMoved, 20}, drift_px);
  ASSERT_EQ(expected.size(), 2u);
  EXPECT_NEAR((expected[1].start - project(kMoved, kTop + beside)).norm(), 0, 1e-6);
}

TEST(LinePrediction, WithoutLinesBesideThemTracksLieAtTheDepthGivenAndDriftOn) {
  SlidingWindow window({}, line_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  const LineTrack track = track_of(LineId(8), SE3(), kTop, kBottom);
  const std::map<LineId, double> still, drifting = {{LineId(8), 2.5}};
  const auto at_4 = predict_segments(line_camera(), {track}, window, {SE3(), kMoved, 4}, still);
  EXPECT_NEAR((at_4[0].start - project(kMoved, kTop)).norm(), 0, 1e-9);
  const auto drifted =
      predict_segments(line_camera(), {track}, window, {SE3(), kMoved, 4}, drifting);
  EXPECT_NEAR((drifted[0].start - at_4[0].start - 2.5 * at_4[0].normal()).norm(), 0, 1e-9);
  EXPECT_NEAR((drifted[0].end - at_4[0].end - 2.5 * at_4[0].normal()).norm(), 0, 1e-9);
}

}  // namespace line_prediction_test
}  // namespace placegraph
