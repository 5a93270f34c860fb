#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/window_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace window_second_camera_test {

const Eigen::Vector3d kRightCamera(0.5, 0, 0);

/// What a segment around a point of a line looks like from an eye.
std::pair<Eigen::Vector2d, Eigen::Vector2d> ends_of(const Camera& camera, const SE3& T_map_second,
                                                    const Eigen::Vector3d& middle,
                                                    const Eigen::Vector3d& direction) {
  const SE3 T_second_map = T_map_second.inverse();
  return {*camera.project(T_second_map * (middle - direction)),
          *camera.project(T_second_map * (middle + direction))};
}

/// Keyframes of a short drive that see lines with both eyes.
struct Drive {
  Camera camera = test::window_camera();
  std::vector<SE3> T_map_cam;
  std::vector<Line3> lines;
  std::vector<LineObservation> observations;
};
Drive make_drive(int keyframes, Random& random) {
  Drive drive;
  for (int k = 0; k < keyframes; ++k)
    drive.T_map_cam.emplace_back(SO3::exp({0.01 * k, 0.04 * k, 0}),
                                 Eigen::Vector3d(0.1 * k, 0, 0.7 * k));
  for (int i = 0; i < 25; ++i) {
    const Eigen::Vector3d middle(random.uniform(-4, 4), random.uniform(-1.5, 1.5),
                                 random.uniform(8, 14));
    const Eigen::Vector3d direction =
        Eigen::Vector3d(random.normal(), random.normal() + 1, random.normal()).normalized();
    drive.lines.push_back(Line3::from_direction(middle, direction));
    for (int k = 0; k < keyframes; ++k) {
      const SE3& T = drive.T_map_cam[static_cast<std::size_t>(k)];
      const auto [a, b] = ends_of(drive.camera, T, middle, direction);
      const auto [c, d] = ends_of(drive.camera, T * SE3(SO3(), kRightCamera), middle, direction);
      LineObservation o{KeyframeId(k), LineId(i), a, b, 0.5, {}};
      o.second = LineObservation::SecondCamera{kRightCamera, c, d, 0.5};
      drive.observations.push_back(o);
    }
  }
  return drive;
}

/// With the later keyframes and all lines where a map of another unit would have them.
SlidingWindow stretched(const Drive& drive, double scale,
                        const SlidingWindowOptions& options = {}) {
  SlidingWindow window(options, drive.camera);
  for (std::size_t k = 0; k < drive.T_map_cam.size(); ++k)
    window.add_keyframe(KeyframeId(k), drive.T_map_cam[k].scaled(scale));
  for (std::size_t i = 0; i < drive.lines.size(); ++i)
    window.add_line(
        LineId(static_cast<std::int64_t>(i)),
        Line3::from_direction(scale * drive.lines[i].nearest_point(), drive.lines[i].direction()));
  for (const LineObservation& o : drive.observations) window.add_line_observation(o);
  return window;
}

TEST(SlidingWindowLines, OfAStereoPairGiveTheScaleFromTwoKeyframes) {
  Random random = test::seeded_random(50);
  const Drive drive = make_drive(2, random);
  SlidingWindow window = stretched(drive, 1.15);
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_LT((drive.T_map_cam[1].inverse() * window.pose(KeyframeId(1))).log().norm(), 1e-3);
  EXPECT_TRUE(relative_covariance(window, KeyframeId(0), KeyframeId(1)))
      << "all six directions are known";
  EXPECT_THROW(window.rescale(2), ArgumentError) << "measured already";
}

TEST(SlidingWindowLines, OfAMonocularCameraSayNothingFromTwoKeyframes) {
  Random random = test::seeded_random(51);
  Drive drive = make_drive(2, random);
  for (LineObservation& o : drive.observations) o.second.reset();
  SlidingWindow window = stretched(drive, 1);
  EXPECT_FALSE(window.optimize().outcome) << "two views of lines";
}

TEST(SlidingWindowLines, OfAStereoPairStayMetricWhenTheyAreMarginalized) {
  Random random = test::seeded_random(52);
  Drive drive = make_drive(6, random);
  // The last keyframe no longer sees half of the lines: they leave with the oldest.
  std::erase_if(drive.observations, [](const LineObservation& o) {
    return o.line.value() % 2 && o.keyframe == KeyframeId(5);
  });
  SlidingWindow window = stretched(drive, 1.05, {.max_keyframes = 4});
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_EQ(window.marginalize().size(), 2u);
  ASSERT_TRUE(window.optimize().outcome);
  const SE3 T_2_5 = window.pose(KeyframeId(2)).inverse() * window.pose(KeyframeId(5));
  const SE3 truth = drive.T_map_cam[2].inverse() * drive.T_map_cam[5];
  EXPECT_LT((truth.inverse() * T_2_5).log().norm(), 1e-3);
  EXPECT_LT(residual_px(window, window.line_observations(LineId(0)).back())->norm(), 0.05);
}

TEST(SlidingWindowLines, ASecondCameraMustLieElsewhereAndBeFinite) {
  Random random = test::seeded_random(53);
  const Drive drive = make_drive(2, random);
  SlidingWindow window({}, drive.camera);
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_line(LineId(0), drive.lines[0]);
  LineObservation o = drive.observations[0];
  o.second->second_in_cam.setZero();
  EXPECT_THROW(window.add_line_observation(o), ArgumentError);
  o = drive.observations[0];
  o.second->sigma_px = 0;
  EXPECT_THROW(window.add_line_observation(o), ArgumentError);
}

}  // namespace window_second_camera_test
}  // namespace placegraph
