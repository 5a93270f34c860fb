#include <gtest/gtest.h>
#include <placegraph/pipeline/local_map/metric_scale.h>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace metric_scale_test {

using namespace test;

constexpr std::int64_t kSecond = 1'000'000'000;

/// A camera that moves one unit of the map per second along its axis, and two metres.
struct Walk {
  LocalMap map{{}, window_camera(), Scale::kArbitrary};
  MetricScale scale{{}};

  explicit Walk(const std::vector<double>& metres = std::vector<double>(12, 2.0)) {
    std::vector<MotionStep> steps;
    for (std::size_t k = 0; k < metres.size(); ++k) {
      MotionStep step;
      step.from_ns = static_cast<std::int64_t>(k) * kSecond;
      step.to_ns = static_cast<std::int64_t>(k + 1) * kSecond;
      step.T_from_to = SE3(SO3(), Eigen::Vector3d(0, 0, metres[k]));
      step.covariance = 1e-4 * Matrix6d::Identity();
      steps.push_back(step);
    }
    scale.use_motion(std::make_shared<const MeasuredMotion>(steps));
  }
  std::optional<Rescale> add(int k) {
    const double unit = map.metric() ? 2 : 1;
    map.add_keyframe(SE3(SO3(), Eigen::Vector3d(0, 0, unit * k)));
    map.update_poses({}, false);
    Frame frame;
    frame.id = FrameId(k);
    frame.stamp_ns = k * kSecond;
    return scale.measure({frame, {}, nullptr}, {}, map);
  }
};

TEST(MetricScale, NeedsSomethingToMeasureBy) {
  MetricScale none{{}};
  EXPECT_FALSE(none.available());
  EXPECT_TRUE(none.ground_outline_px().empty());
  EXPECT_TRUE(Walk().scale.available());
  none.use_ground_plane({}, window_camera(), 1.65);
  EXPECT_TRUE(none.available());
  EXPECT_TRUE(none.uses_ground_plane());
  EXPECT_FALSE(none.uses_floor_lines());
  EXPECT_FALSE(none.ground_outline_px().empty());
}

TEST(MetricScale, FiveMeasuredMotionsGiveTheScale) {
  Walk walk;
  for (int k = 0; k < 5; ++k) EXPECT_FALSE(walk.add(k)) << k;
  const auto rescale = walk.add(5);
  ASSERT_TRUE(rescale);
  EXPECT_NEAR(rescale->factor, 2, 1e-9);
  EXPECT_TRUE(walk.map.metric());
  EXPECT_NEAR(walk.map.window().pose(KeyframeId(5)).translation().z(), 10, 1e-9);
  EXPECT_NEAR(walk.map.pose(KeyframeId(5)).translation().z(), 10, 1e-9);
}

TEST(MetricScale, OnceItIsKnownEveryMotionIsADistanceInTheWindow) {
  Walk walk;
  for (int k = 0; k < 6; ++k) (void)walk.add(k);
  const std::size_t at_once = walk.map.window().factors().size();
  EXPECT_EQ(at_once, 5u);
  EXPECT_FALSE(walk.add(6));
  EXPECT_EQ(walk.map.window().factors().size(), at_once + 1);
  const WindowFactor& newest = walk.map.window().factors().back();
  EXPECT_EQ(newest.variables,
            (std::vector{keyframe_variable(KeyframeId(5)), keyframe_variable(KeyframeId(6))}));
}

TEST(MetricScale, AMotionThatSlipsIsOutvoted) {
  Walk walk({2, 2, 20, 2, 2, 2, 2, 2});
  std::optional<Rescale> rescale;
  for (int k = 0; k < 6 && !rescale; ++k) rescale = walk.add(k);
  ASSERT_TRUE(rescale);
  EXPECT_NEAR(rescale->factor, 2, 1e-9);
}

TEST(MetricScale, MotionThatIsLittleKnownAgainstItsLengthTellsNothing) {
  std::vector<MotionStep> steps;
  for (int k = 0; k < 12; ++k) {
    MotionStep step;
    step.from_ns = k * kSecond, step.to_ns = (k + 1) * kSecond;
    step.T_from_to = SE3(SO3(), Eigen::Vector3d(0, 0, 2));
    step.covariance = Matrix6d::Identity() * 1.21;  // deviation 1.1 m of 2 m
    steps.push_back(step);
  }
  Walk walk;
  walk.scale.use_motion(std::make_shared<const MeasuredMotion>(steps));
  for (int k = 0; k < 10; ++k) EXPECT_FALSE(walk.add(k));
  EXPECT_FALSE(walk.map.metric());
}

TEST(MetricScale, BeginsAnewWithTheSegment) {
  Walk walk;
  for (int k = 0; k < 4; ++k) (void)walk.add(k);
  walk.scale.reset();
  walk.map.restart(Scale::kArbitrary, std::nullopt);
  // The stamps of four keyframes are forgotten: five more motions are needed.
  for (int k = 4; k < 9; ++k) EXPECT_FALSE(walk.add(k)) << k;
  EXPECT_TRUE(walk.add(9));
}

TEST(MetricScale, LawTheUnitOfTheMapChangesTheFactorAlone) {
  for (const double unit : {0.01, 1.0, 40.0}) {
    Walk walk;
    std::optional<Rescale> rescale;
    for (int k = 0; k < 6; ++k) {
      walk.map.add_keyframe(SE3(SO3(), Eigen::Vector3d(0, 0, unit * k)));
      walk.map.update_poses({}, false);
      Frame frame;
      frame.id = FrameId(k);
      frame.stamp_ns = k * kSecond;
      rescale = walk.scale.measure({frame, {}, nullptr}, {}, walk.map);
    }
    ASSERT_TRUE(rescale);
    EXPECT_NEAR(rescale->factor * unit, 2, 1e-9);
  }
}

}  // namespace metric_scale_test
}  // namespace placegraph
