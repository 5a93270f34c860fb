#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/sweep_geometry.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace sweep_geometry_test {

Camera test_camera() { return {160, 120, 130, 120, 79.5, 59.5}; }
const SE3 kMoved(SO3::exp({0.05, -0.1, 0.02}), Eigen::Vector3d(-0.3, 0.1, -0.2));

constexpr SweepRange kRange{.min_depth_m = 0.7, .max_depth_m = 15, .step_px = 1, .max_levels = 192};

SweepGeometry geometry_of(const std::vector<SE3>& T_view_cam, const SweepRange& range = kRange) {
  return sweep_geometry(test_camera(), T_view_cam, range);
}

TEST(SweepGeometry, SaysWhereAViewSeesAPixelOfADepth) {
  const Camera camera = test_camera();
  const SweepGeometry geometry = geometry_of({kMoved});
  for (const double depth : {1.0, 3.0, 12.0})
    for (const Eigen::Vector2d& px : {Eigen::Vector2d(10, 20), {79, 60}, {140, 100}}) {
      const Eigen::Vector3d p_view = kMoved * Eigen::Vector3d(depth * *camera.unproject(px));
      const Eigen::Vector3d seen = geometry.views[0].at(px[0], px[1], 1 / depth);
      EXPECT_LT((seen.hnormalized() - *camera.project(p_view)).norm(), 1e-9);
      EXPECT_NEAR(seen[2], p_view[2] / depth, 1e-12);
      const Eigen::Vector3d by_homography =
          geometry.views[0].homography(1 / depth) * px.homogeneous();
      EXPECT_LT((by_homography - seen).norm(), 1e-9);
    }
}

TEST(SweepGeometry, TheRateIsTheDerivativeByInverseDepth) {
  const auto view = geometry_of({kMoved}).views[0];
  constexpr double kStep = 1e-5;
  for (const double inverse_depth : {0.1, 0.5, 1.2}) {
    const Eigen::Vector2d forward = view.at(30, 40, inverse_depth + kStep).hnormalized(),
                          back = view.at(30, 40, inverse_depth - kStep).hnormalized();
    EXPECT_NEAR(view.rate(30, 40, inverse_depth), (forward - back).norm() / (2 * kStep), 1e-4);
  }
}

TEST(SweepGeometry, SweepsFromTheFarthestToTheNearestDepth) {
  SweepRange range = kRange;
  range.min_depth_m = 0.5, range.max_depth_m = 20;
  const SweepGeometry geometry = geometry_of({kMoved}, range);
  ASSERT_GT(geometry.levels, 4);
  EXPECT_NEAR(geometry.inverse_depth(0), 1.0 / 20, 1e-12);
  EXPECT_NEAR(geometry.inverse_depth(geometry.levels - 1), 1 / 0.5, 1e-12);
}

TEST(SweepGeometry, LevelsAreAStepApartForTheViewThatMovesMost) {
  SweepRange range = kRange;
  range.step_px = 2;
  range.max_levels = 1000;
  const SE3 little(SO3(), Eigen::Vector3d(0.05, 0, 0)), much(SO3(), Eigen::Vector3d(0.3, 0, 0));
  const SweepGeometry geometry = geometry_of({little, much}, range);
  // Sideways all depths move by f t.
  EXPECT_NEAR(geometry.step * 130 * 0.3, 2, 2 * 2.0 / (geometry.levels - 1));
  EXPECT_EQ(geometry_of({much}, range).levels, geometry.levels);
  EXPECT_LT(geometry_of({little}, range).levels, geometry.levels / 5);
  range.max_levels = 20;
  EXPECT_EQ(geometry_of({much}, range).levels, 20);
}

TEST(SweepGeometry, HasNoLevelsWhereNothingMoves) {
  EXPECT_EQ(geometry_of({}).levels, 0);
  EXPECT_EQ(geometry_of({SE3(SO3::exp({0, 0.1, 0}), Eigen::Vector3d::Zero())}).levels, 0);
}

TEST(SweepGeometry, OfThreeViewsTwoAreTheBetterHalf) {
  EXPECT_EQ(geometry_of({kMoved}).better_half(), 1U);
  EXPECT_EQ(geometry_of({kMoved, kMoved}).better_half(), 1U);
  EXPECT_EQ(geometry_of({kMoved, kMoved, kMoved}).better_half(), 2U);
}

}  // namespace sweep_geometry_test
}  // namespace placegraph
