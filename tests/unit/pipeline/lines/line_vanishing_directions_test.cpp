#include <gtest/gtest.h>
#include <placegraph/frontend/lines/floor_from_lines.h>
#include <placegraph/pipeline/lines/line_cue.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/scenes/boards.h"

namespace placegraph {
namespace line_vanishing_directions_test {

constexpr int kFrames = 4;
constexpr double kDepth_m = 5, kBaseline_m = 0.5;

/// Straight on, along the corridor.
SE3 path(int i) { return test::pose({0, 0, 0}, {0, 0, 0.12 * i}); }

const Frame& frame(int i) {
  static const std::vector<Frame> frames = test::boards_frames(kFrames, path, kBaseline_m);
  return frames[static_cast<std::size_t>(i)];
}

/// A single eye that goes through a corridor, whose edges share three directions.
struct Walk {
  Calibration calibration;
  LineCue cue;
  SlidingWindow window;
  Random random{1};

  explicit Walk(double baseline_m = 0)
      : calibration(of_boards(baseline_m)),
        cue({}, calibration, {}),
        window({}, calibration.camera) {}
  static Calibration of_boards(double baseline_m) {
    Calibration calibration;
    calibration.camera = test::boards_camera();
    calibration.baseline_m = baseline_m;
    return calibration;
  }
  /// `T_map_cam`: where the window takes the keyframe to be.
  void keyframe(int i, const SE3& T_map_cam) {
    window.add_keyframe(KeyframeId(i), T_map_cam);
    if (i > 0) {
      cue.track(frame(i).image, window, T_map_cam, kDepth_m);
      cue.accept(window, T_map_cam);
    }
    cue.observe(KeyframeId(i), frame(i), {}, kDepth_m, window);
  }
};

/// Squared residual of a factor if its keyframes stood at these poses.
double chi2(const WindowFactor& factor, const std::vector<SE3>& T_map_cam) {
  const std::vector<Variable> poses(T_map_cam.begin(), T_map_cam.end());
  std::vector<const Variable*> values;
  for (const Variable& pose : poses) values.push_back(&pose);
  Eigen::VectorXd r(factor.factor->residual_size());
  EXPECT_TRUE(factor.factor->evaluate(values, r, {}));
  return r.squaredNorm();
}

/// How far a direction is from the nearest axis of the corridor.
double off_the_axes_rad(const Eigen::Vector3d& d) {
  return std::acos(std::min(1.0, d.cwiseAbs().maxCoeff()));
}

TEST(LineVanishingDirections, WithoutOneDirectionsAreNotLearned) {
  Walk walk;
  for (int i = 0; i < 2; ++i) walk.keyframe(i, path(i));
  EXPECT_TRUE(walk.cue.shared_directions().empty());
  walk.cue.constrain_translation(KeyframeId(1), kDepth_m, walk.window);
  EXPECT_TRUE(walk.window.factors().empty());
}

TEST(LineVanishingDirections, LearnsTheDirectionsThatEdgesShareInTheWindowsFrame) {
  Walk walk;
  walk.cue.use_vanishing_directions();
  walk.keyframe(0, path(0));
  const auto shared = walk.cue.shared_directions();
  ASSERT_GE(shared.size(), 2u);
  for (const SharedDirection& direction : shared) {
    EXPECT_LT(off_the_axes_rad(direction.d_ref), 0.02);
    EXPECT_GT(direction.sigma_rad, 0);
  }
  // Learned by the pose that the window has: in a turned window they are turned.
  Walk rotated;
  const SE3 T_map_world = test::pose({0.1, 0.5, 0}, {1, 2, 3});
  rotated.cue.use_vanishing_directions();
  rotated.keyframe(0, T_map_world);
  const auto others = rotated.cue.shared_directions();
  ASSERT_EQ(others.size(), shared.size());
  for (const SharedDirection& direction : others)
    EXPECT_LT(off_the_axes_rad(T_map_world.rotation().inverse() * direction.d_ref), 0.02);
}

TEST(LineVanishingDirections, SteersAKeyframeThatTheWindowHasRotated) {
  Walk walk;
  walk.cue.use_vanishing_directions();
  walk.keyframe(0, path(0));
  EXPECT_TRUE(walk.window.factors().empty());  // nothing was known of directions before
  const SE3 rotated = path(1) * test::pose({0.004, 0.01, -0.006}, {0, 0, 0});
  walk.keyframe(1, rotated);
  ASSERT_EQ(walk.window.factors().size(), 1u);
  const WindowFactor& prior = walk.window.factors().front();
  EXPECT_EQ(prior.variables, std::vector{keyframe_variable(KeyframeId(1))});
  // A deviation of what is known is well below a degree, so the truth is much more probable.
  EXPECT_GT(chi2(prior, {rotated}), 10 * chi2(prior, {path(1)}));
  // Where the keyframe stands is not told.
  const SE3 aside(rotated.rotation(), rotated.translation() + Eigen::Vector3d(3, 2, 1));
  EXPECT_NEAR(chi2(prior, {aside}), chi2(prior, {rotated}), 1e-6 * chi2(prior, {rotated}));
}

TEST(LineVanishingDirections, EarlierKeyframesAreSteeredInOrder) {
  Walk walk;
  walk.cue.use_vanishing_directions();
  std::vector<LineView> seen;
  for (int i = 0; i < 3; ++i) {
    walk.cue.track_uninitialized(frame(i), path(0));
    seen.push_back(walk.cue.seen());
  }
  for (int i = 0; i < 3; ++i) {
    walk.window.add_keyframe(KeyframeId(i), path(i));
    walk.cue.observe_earlier(KeyframeId(i), seen[static_cast<std::size_t>(i)], walk.window);
  }
  ASSERT_EQ(walk.window.factors().size(), 2u);
  EXPECT_EQ(walk.window.factors()[0].variables, std::vector{keyframe_variable(KeyframeId(1))});
  EXPECT_EQ(walk.window.factors()[1].variables, std::vector{keyframe_variable(KeyframeId(2))});
}

TEST(LineVanishingDirections, LinesAlongTheWayHoldTheCourse) {
  Walk walk;
  walk.cue.use_vanishing_directions();
  const SE3 aside = path(2) * test::pose({0, 0, 0}, {0.05, 0, 0});
  walk.keyframe(0, path(0));
  walk.keyframe(1, path(1));
  walk.keyframe(2, aside);
  const std::size_t before = walk.window.factors().size();
  walk.cue.constrain_translation(KeyframeId(2), kDepth_m, walk.window);
  ASSERT_GT(walk.window.factors().size(), before);
  int from_first = 0;
  for (const WindowFactor& motion : walk.window.factors()) {
    if (motion.variables.size() != 2) continue;
    EXPECT_EQ(motion.variables[1], keyframe_variable(KeyframeId(2)));
    if (motion.variables[0] != keyframe_variable(KeyframeId(0))) continue;
    ++from_first;
    EXPECT_GT(chi2(motion, {path(0), aside}), 10 * chi2(motion, {path(0), path(2)}));
    // How far it went is open.
    EXPECT_LT(chi2(motion, {path(0), path(3)}), 0.1 * chi2(motion, {path(0), aside}));
  }
  EXPECT_EQ(from_first, 1);
}

TEST(LineVanishingDirections, AResetForgetsTheDirectionsButGoesOnLearning) {
  Walk walk;
  walk.cue.use_vanishing_directions();
  walk.keyframe(0, path(0));
  ASSERT_FALSE(walk.cue.shared_directions().empty());
  walk.cue.reset();
  EXPECT_TRUE(walk.cue.shared_directions().empty());
  Walk next;
  next.cue = std::move(walk.cue);
  next.keyframe(0, path(0));
  EXPECT_FALSE(next.cue.shared_directions().empty());
}

TEST(LineVanishingDirections, FewLinesPoseAFrameWhoseRotationIsSeen) {
  Walk with(kBaseline_m), without(kBaseline_m);
  with.cue.use_vanishing_directions();
  for (Walk* walk : {&with, &without}) {
    walk->keyframe(0, path(0));
    // Of every direction one or two are left.
    std::array<int, 3> kept{};
    for (const LineId id : walk->window.lines()) {
      Eigen::Index axis = 0;
      walk->window.line(id)->direction().cwiseAbs().maxCoeff(&axis);
      if (++kept[static_cast<std::size_t>(axis)] > 2) walk->window.remove_line(id);
    }
    walk->cue.track(frame(1).image, walk->window, path(0), kDepth_m);
  }
  ASSERT_LT(with.cue.followed(with.window), 6);
  Matrix6d weak = Matrix6d::Identity();
  weak.bottomRightCorner<3, 3>() *= 1 / (0.02 * 0.02);
  const PoseGuess guess{path(0) * test::pose({0.006, -0.01, 0.004}, {0, 0, 0}), weak};
  EXPECT_FALSE(without.cue.pose(without.window, guess, without.random).outcome);
  const PoseFromLines found = with.cue.pose(with.window, guess, with.random);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_LT((found.T_ref_cam.rotation().inverse() * path(1).rotation()).log().norm(), 0.004);
  EXPECT_LT((found.T_ref_cam.translation() - path(1).translation()).norm(), 0.05);
}

}  // namespace line_vanishing_directions_test
}  // namespace placegraph
