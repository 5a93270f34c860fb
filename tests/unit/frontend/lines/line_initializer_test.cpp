#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_initializer.h>

#include "tests/support/scenes/room_lines.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace line_initializer_test {

using namespace test;
using Code = Outcome::Code;

SE3 on_the_path(int k) {
  return SE3(SO3::exp({0.002 * k, 0.01 * k, -0.001 * k}),
             Eigen::Vector3d(0.03 * k, 0.01 * k, 0.12 * k));
}

std::vector<LineView> drive(int count, double noise_px, Random& random) {
  std::vector<LineView> views;
  for (int k = 0; k < count; ++k)
    views.push_back(view_of(corridor_lines(), on_the_path(k), noise_px, random));
  return views;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

TEST(LineInitializer, FindsMotionUpToScaleFromViewsOfACorridor) {
  Random random = seeded_random(51);
  const LineScene scene = corridor_lines();
  const auto start =
      initialize_from_lines(scene.camera, drive(7, 0.05, random), LineInitializerOptions{}, random);
  ASSERT_TRUE(start.outcome) << start.outcome.reason;
  ASSERT_EQ(start.T_ref_view.size(), 7u);
  const double unit = on_the_path(6).translation().norm();
  EXPECT_NEAR(start.T_ref_view[6].translation().norm(), 1, 1e-9);
  for (int k = 1; k < 7; ++k) {
    const SE3& T = start.T_ref_view[static_cast<std::size_t>(k)];
    // Directions of dozens of lines of 0.05 px: about a milliradian; a way of 0.7 m at 5 m of depth
    // turns that into some percent.
    EXPECT_LT((T.rotation().inverse() * on_the_path(k).rotation()).log().norm(), 4e-3) << k;
    EXPECT_LT((unit * T.translation() - on_the_path(k).translation()).norm(), 0.08 * unit) << k;
  }
  EXPECT_LT(angle_between(start.T_ref_view[6].translation(), on_the_path(6).translation()), 0.06);
  EXPECT_GE(start.lines.size(), 12u);
}

TEST(LineInitializer, SaysThatTwoViewsOfLinesTellNothing) {
  Random random = seeded_random(52);
  const auto start = initialize_from_lines(corridor_lines().camera, drive(2, 0.05, random),
                                           LineInitializerOptions{}, random);
  EXPECT_EQ(start.outcome.code, Code::kTooFewData);
}

TEST(LineInitializer, NeedsLinesThatAllViewsSee) {
  Random random = seeded_random(53);
  auto views = drive(5, 0.05, random);
  while (views.back().size() > 8) views.back().erase(views.back().begin());
  const auto start =
      initialize_from_lines(corridor_lines().camera, views, LineInitializerOptions{}, random);
  EXPECT_EQ(start.outcome.code, Code::kTooFewData);
}

TEST(LineInitializer, SaysNothingOfACameraThatStandsOrOnlyRotates) {
  Random random = seeded_random(54);
  const LineScene scene = corridor_lines();
  std::vector<LineView> views;
  for (int k = 0; k < 6; ++k)
    views.push_back(
        view_of(scene, SE3(SO3::exp({0, 0.02 * k, 0}), Eigen::Vector3d::Zero()), 0.05, random));
  const auto start = initialize_from_lines(scene.camera, views, LineInitializerOptions{}, random);
  EXPECT_FALSE(start.outcome);
}

}  // namespace line_initializer_test
}  // namespace placegraph
