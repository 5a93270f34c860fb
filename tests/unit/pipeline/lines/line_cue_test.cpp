#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/lines/line_cue.h>

#include <map>

#include "tests/support/scenes/boards.h"
#include "tests/unit/pipeline/lines/edge_tracks.h"

namespace placegraph {
namespace line_cue_test {

using namespace test;

/// Four keyframes along x see upright lines at depths of 4 to 9 m; the right eye, half a metre to
/// the right, is off by `error`.
struct Pair {
  Calibration calibration;
  SlidingWindow window;
  explicit Pair(const RectificationError& error) : window({}, line_camera()) {
    calibration.camera = line_camera();
    calibration.baseline_m = 0.5;
    for (int k = 0; k < 4; ++k)
      window.add_keyframe(KeyframeId(k), SE3(SO3(), Eigen::Vector3d(0.4 * k, 0, 0)));
    for (int i = 0; i < 6; ++i) {
      const double x = -1 + 0.5 * i, z = 4 + i;
      window.add_line(LineId(i), Line3::from_direction({x, 0, z}, {0, 1, 0}));
      for (int k = 0; k < 4; ++k) {
        const double u = 320 + 500 * (x - 0.4 * k) / z, d = 500 * 0.5 / z;
        LineObservation o{KeyframeId(k), LineId(i), {u, 140}, {u, 340}, 0.2, {}};
        const auto right = [&](double v) {
          return Eigen::Vector2d(u - d - error.at({(u - 320) / 500, (v - 240) / 500}), v);
        };
        o.second = LineObservation::SecondCamera{{0.5, 0, 0}, right(150), right(330), 0.2};
        window.add_line_observation(o);
      }
    }
  }
  LineCue cue() const { return LineCue({}, calibration, {}); }
};

TEST(LineCue, DisparitiesOfLinesShowWhatARightCameraIsOffBy) {
  const RectificationError error{-0.4, 0.3, 0};
  const Pair pair(error);
  LineCue cue = pair.cue();
  const auto samples = cue.disparity_samples(pair.window, {});
  ASSERT_EQ(samples.size(), 6u);
  for (const DisparitySample& s : samples)
    EXPECT_NEAR(s.measured_px - s.from_motion_px, error.at(s.ray), 1e-6);
  EXPECT_TRUE(cue.disparity_samples(pair.window, {}).empty());  // each line is heard once
}

TEST(LineCue, RevisedRightCamerasLieWhereARectifiedOneWouldSeeTheLines) {
  const RectificationError error{-0.4, 0.3, 0.2};
  Pair off(error);
  const Pair good({});
  off.cue().revise_second_cameras(off.window, {}, error);
  for (const LineId id : good.window.lines())
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& revised = *off.window.line_observations(id)[k].second;
      const auto& wanted = *good.window.line_observations(id)[k].second;
      EXPECT_NEAR((revised.start_px - wanted.start_px).norm(), 0, 1e-9);
      EXPECT_NEAR((revised.end_px - wanted.end_px).norm(), 0, 1e-9);
    }
}

TEST(LineCue, OnlyASecondCameraThatIsThereCanBeRevised) {
  Pair pair({});
  const LineObservation::SecondCamera second_camera{{0.5, 0, 0}, {1, 2}, {1, 9}, 0.2};
  EXPECT_THROW(pair.window.revise_second_camera(KeyframeId(9), LineId(0), second_camera),
               ArgumentError);
  EXPECT_THROW(pair.window.revise_second_camera(KeyframeId(0), LineId(99), second_camera),
               ArgumentError);
  EXPECT_THROW(
      pair.window.revise_second_camera(KeyframeId(0), LineId(0), {{0, 0, 0}, {1, 2}, {1, 9}, 0.2}),
      ArgumentError);
}

constexpr double kBoardsBaseline_m = 0.5;

SE3 boards_path(int i) { return pose({0, 0.004 * i, 0}, {0.05 * i, -0.03 * i, 0.1 * i}); }

const std::vector<Frame>& boards_drive() {
  static const std::vector<Frame> frames = boards_frames(5, boards_path, kBoardsBaseline_m);
  return frames;
}

/// A camera on its way through a corridor of boards.
struct Corridor {
  Calibration calibration;
  LineCue cue;
  SlidingWindow window;
  Random random{1};

  explicit Corridor(bool stereo = true)
      : calibration(of_boards(stereo)), cue({}, calibration, {}), window({}, calibration.camera) {}
  static Calibration of_boards(bool stereo) {
    Calibration calibration;
    calibration.camera = boards_camera();
    if (stereo) calibration.baseline_m = kBoardsBaseline_m;
    return calibration;
  }
  static const Frame& frame(int i) { return boards_drive()[static_cast<std::size_t>(i)]; }
  void keyframe(int i) {
    window.add_keyframe(KeyframeId(i), boards_path(i));
    if (i > 0) {
      cue.track(frame(i).image, window, boards_path(i), 5);
      cue.accept(window, boards_path(i));
    }
    cue.observe(KeyframeId(i), frame(i), {}, 5, window);
  }
  /// By what angle the lines of the window miss the nearest axis of the corridor; their median.
  double off_the_axes_rad() const {
    std::vector<double> off;
    for (const LineId id : window.lines())
      off.push_back(std::acos(std::min(1.0, window.line(id)->direction().cwiseAbs().maxCoeff())));
    return median_of(off);
  }
};

TEST(LineCue, DisparitiesPlaceLinesWithTheFirstKeyframe) {
  Corridor c;
  c.keyframe(0);
  ASSERT_GT(c.window.lines().size(), 15u);
  EXPECT_LT(c.off_the_axes_rad(), 0.02);
  for (const double depth : c.cue.depths(c.window)) {
    EXPECT_GT(depth, 1);
    EXPECT_LT(depth, 13);
  }
  EXPECT_EQ(c.cue.placed(c.window).size(), c.cue.depths(c.window).size());
  EXPECT_EQ(c.cue.followed(c.window), static_cast<int>(c.window.lines().size()));
}

TEST(LineCue, MotionPlacesTheLinesOfASingleCamera) {
  Corridor c(false);
  c.keyframe(0);
  EXPECT_TRUE(c.window.lines().empty());  // one view of a line shows no depth
  for (int i = 1; i < 5; ++i) c.keyframe(i);
  ASSERT_GT(c.window.lines().size(), 8u);
  EXPECT_LT(c.off_the_axes_rad(), 0.05);
  // What was seen before a line was placed counts, too.
  for (const LineId id : c.window.lines()) EXPECT_GE(c.window.line_observations(id).size(), 2u);
}

TEST(LineCue, PosesAFrameByTheLinesThatItFollows) {
  Corridor c;
  c.keyframe(0);
  c.cue.track(Corridor::frame(1).image, c.window, boards_path(0), 5);
  const PoseGuess guess{boards_path(0), Matrix6d::Identity()};
  const PoseFromLines found = c.cue.pose(c.window, guess, c.random);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_LT((found.T_ref_cam.inverse() * boards_path(1)).log().norm(), 0.02);
}

TEST(LineCue, LinesThatContradictThePoseAreNoLongerFollowed) {
  Corridor right, wrong;
  for (Corridor* c : {&right, &wrong}) {
    c->keyframe(0);
    c->cue.track(Corridor::frame(1).image, c->window, boards_path(1), 5);
  }
  right.cue.accept(right.window, boards_path(1));
  wrong.cue.accept(wrong.window, boards_path(1) * pose({0, 0.1, 0}, {0, 0, 0}));
  EXPECT_GT(right.cue.followed(right.window), 10);
  EXPECT_LT(wrong.cue.followed(wrong.window), right.cue.followed(right.window) / 2);
}

TEST(LineCue, LinesThatTheNewestKeyframeContradictsAreDropped) {
  Corridor c;
  c.keyframe(0);
  const std::size_t all = c.window.lines().size();
  c.cue.prune(c.window);
  EXPECT_EQ(c.window.lines().size(), all);
  const LineId moved = c.window.lines().front();
  const Line3 line = *c.window.line(moved);
  c.window.remove_line(moved);
  c.window.add_line(moved, Line3::from_direction(line.nearest_point() + Eigen::Vector3d(1, 1, 1),
                                                 line.direction()));
  c.window.add_line_observation({KeyframeId(0), moved, {100, 100}, {100, 200}, 0.2, {}});
  c.cue.prune(c.window);
  EXPECT_FALSE(c.window.line(moved));
  EXPECT_EQ(c.window.lines().size(), all - 1);
}

TEST(LineCue, TellsHowFarLinesHaveMovedSinceTheKeyframe) {
  Corridor c;
  c.keyframe(0);
  ASSERT_GT(c.cue.flow_px().size(), 15u);
  for (const double px : c.cue.flow_px()) EXPECT_LT(px, 1e-9);
  std::map<LineId, Eigen::Vector2d> middle_px;
  for (const FrameView::Line& line : c.cue.view(c.window, boards_path(0)))
    middle_px[line.id] = line.segment.middle();
  c.cue.track(Corridor::frame(2).image, c.window, boards_path(2), 5);
  const std::vector<double> flow = c.cue.flow_px();
  const std::vector<FrameView::Line> now = c.cue.view(c.window, boards_path(2));
  ASSERT_EQ(flow.size(), now.size());
  // How far the middle of an edge is from where its line is now.
  std::vector<double> expected, off;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto line = c.window.line(now[i].id);
    if (!line) continue;
    const Eigen::Vector2d& px = middle_px.at(now[i].id);
    const auto r = line_residual_px(c.calibration.camera, boards_path(2), *line, px, px);
    ASSERT_TRUE(r);
    expected.push_back(std::abs((*r)[0]));
    off.push_back(std::abs(flow[i] - expected.back()));
  }
  ASSERT_GT(off.size(), 10u);
  EXPECT_GT(median_of(expected), 2);  // px; much more than what they may be off by
  // Edges are found to 0.2 px in both frames, and lines are placed by such edges.
  EXPECT_LT(median_of(off), std::sqrt(3) * 0.2);
}

TEST(LineCue, ItsViewShowsWhereLinesOfTheWindowAreProjected) {
  Corridor c;
  c.keyframe(0);
  int judged = 0;
  for (const FrameView::Line& line : c.cue.view(c.window, boards_path(0)))
    if (line.off_px) {
      ++judged;
      EXPECT_LT(*line.off_px, 1);
    }
  ASSERT_GT(judged, 15);
  EXPECT_EQ(judged, c.cue.followed(c.window));
}

TEST(LineCue, ItsFeaturesCarryLinesInTheCameraAtTheDepthThatTheyAreSeenAt) {
  Corridor c;
  c.keyframe(0);
  const SE3 T_other = pose({0, 0.5, 0}, {3, 0, 0});
  const auto here = c.cue.features(c.window, boards_path(0)),
             there = c.cue.features(c.window, T_other);
  ASSERT_EQ(here.size(), there.size());
  std::vector<double> depths;
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(here[i].line_cam.has_value(), there[i].line_cam.has_value());
    if (!here[i].line_cam) continue;
    const auto z =
        depth_on_line(c.calibration.camera, SE3(), *here[i].line_cam, here[i].segment.middle());
    ASSERT_TRUE(z);
    depths.push_back(*z);
    // Both cameras have it at one place of the world.
    const Eigen::Vector3d of_here = boards_path(0) * here[i].line_cam->nearest_point(),
                          of_there = T_other * there[i].line_cam->nearest_point(),
                          direction = T_other.rotation() * there[i].line_cam->direction();
    EXPECT_LT(direction.cross(boards_path(0).rotation() * here[i].line_cam->direction()).norm(),
              1e-9);
    EXPECT_LT(direction.cross(of_there - of_here).norm(), 1e-9);
  }
  const std::vector<double> wanted = c.cue.depths(c.window);
  ASSERT_GT(wanted.size(), 15u);
  ASSERT_EQ(depths.size(), wanted.size());
  for (std::size_t i = 0; i < depths.size(); ++i) EXPECT_NEAR(depths[i], wanted[i], 1e-9);
}

TEST(LineCue, AResetForgetsEverything) {
  Corridor c;
  c.keyframe(0);
  c.cue.reset();
  EXPECT_TRUE(c.cue.seen().empty());
  EXPECT_EQ(c.cue.followed(c.window), 0);
  EXPECT_TRUE(c.cue.flow_px().empty());
  EXPECT_TRUE(c.cue.placed(c.window).empty());
}

}  // namespace line_cue_test
}  // namespace placegraph
