#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/lines/line_cue.h>

#include "tests/unit/pipeline/lines/line_scene.h"

namespace placegraph {
namespace {

/// Four keyframes along x see upright lines at depths of 4 to 9 m; the right eye, half a metre to
/// the right, is off by `error`.
struct Pair {
  Calibration calibration;
  SlidingWindow window;
  explicit Pair(const RectificationError& error) : window({}, line_camera()) {
    calibration.camera = line_camera();
    calibration.baseline_m = 0.5;
    for (int k = 0; k < 4; ++k) window.add_keyframe(k, SE3(SO3(), Eigen::Vector3d(0.4 * k, 0, 0)));
    for (int i = 0; i < 6; ++i) {
      const double x = -1 + 0.5 * i, z = 4 + i;
      window.add_line(i, Line3::from_direction({x, 0, z}, {0, 1, 0}));
      for (int k = 0; k < 4; ++k) {
        const double u = 320 + 500 * (x - 0.4 * k) / z, d = 500 * 0.5 / z;
        LineObservation o{k, i, {u, 140}, {u, 340}, 0.2, {}};
        const auto right = [&](double v) {
          return Eigen::Vector2d(u - d - error.at({(u - 320) / 500, (v - 240) / 500}), v);
        };
        o.second = LineObservation::SecondEye{{0.5, 0, 0}, right(150), right(330), 0.2};
        window.add_line_observation(o);
      }
    }
  }
  LineCue cue() const { return LineCue({}, calibration, {}); }
};

TEST(LineCue, DisparitiesOfLinesShowWhatARightEyeIsOffBy) {
  const RectificationError error{-0.4, 0.3, 0};
  const Pair pair(error);
  LineCue cue = pair.cue();
  const auto samples = cue.disparity_samples(pair.window, {});
  ASSERT_EQ(samples.size(), 6u);
  for (const DisparitySample& s : samples)
    EXPECT_NEAR(s.measured_px - s.from_motion_px, error.at(s.ray), 1e-6);
  EXPECT_TRUE(cue.disparity_samples(pair.window, {}).empty());  // each line is heard once
}

TEST(LineCue, RevisedRightEyesLieWhereARectifiedOneWouldSeeTheLines) {
  const RectificationError error{-0.4, 0.3, 0.2};
  Pair off(error);
  const Pair good({});
  off.cue().revise_eyes(off.window, {}, error);
  for (const std::int64_t id : good.window.lines())
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& revised = *off.window.line_observations(id)[k].second;
      const auto& wanted = *good.window.line_observations(id)[k].second;
      EXPECT_NEAR((revised.start_px - wanted.start_px).norm(), 0, 1e-9);
      EXPECT_NEAR((revised.end_px - wanted.end_px).norm(), 0, 1e-9);
    }
}

TEST(LineCue, OnlyASecondEyeThatIsThereCanBeRevised) {
  Pair pair({});
  const LineObservation::SecondEye eye{{0.5, 0, 0}, {1, 2}, {1, 9}, 0.2};
  EXPECT_THROW(pair.window.revise_second_eye(9, 0, eye), ArgumentError);
  EXPECT_THROW(pair.window.revise_second_eye(0, 99, eye), ArgumentError);
  EXPECT_THROW(pair.window.revise_second_eye(0, 0, {{0, 0, 0}, {1, 2}, {1, 9}, 0.2}),
               ArgumentError);
}

}  // namespace
}  // namespace placegraph
