#include <gtest/gtest.h>
#include <placegraph/frontend/lines/floor_from_lines.h>

#include "tests/support/scenes/room_lines.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace floor_from_lines_test {

using namespace test;
using Code = Outcome::Code;

/// The lines of a corridor as the camera at `T_ref_cam` sees them, placed with an error of `sigma`
/// of their tangents.
std::vector<PlacedLine> placed(const LineScene& scene, const SE3& T_ref_cam, double sigma,
                               Random& random) {
  std::vector<PlacedLine> lines;
  for (std::size_t i = 0; i < scene.from.size(); ++i) {
    const auto start = scene.camera.project(T_ref_cam.inverse() * scene.from[i]);
    const auto end = scene.camera.project(T_ref_cam.inverse() * scene.to[i]);
    if (!start || !end) continue;
    Eigen::Vector4d error;
    for (int k = 0; k < 4; ++k) error[k] = sigma * random.normal();
    lines.push_back({LineId(i),
                     scene.line(i).plus(error),
                     sigma * sigma * Eigen::Matrix4d::Identity(),
                     {*start, *end}});
  }
  return lines;
}

TEST(FloorFromLines, IsTheLowestLevelThatEnoughLinesAgreeOn) {
  Random random = seeded_random(71);
  const LineScene scene = corridor_lines();
  const SE3 T(SO3::exp({0.05, 0.1, 0.02}), Eigen::Vector3d(0.1, 0, 0.4));
  const auto floor = floor_from_lines(scene.camera, T, placed(scene, T, 1e-3, random), {});
  ASSERT_TRUE(floor.outcome) << floor.outcome.reason;
  // 1e-3 of the tangent of a line at 5 m are centimetres, over a dozen lines.
  EXPECT_NEAR(floor.height, 1.4, 0.02);
  EXPECT_GT(floor.down_ref.y(), std::cos(0.01));
  EXPECT_GT(floor.sigma_height, 0.002);
  EXPECT_LT(floor.sigma_height, 0.03);
  for (const LineId id : floor.on_floor) {
    const auto i = static_cast<std::size_t>(id.value());
    EXPECT_NEAR(std::max(scene.from[i].y(), scene.to[i].y()), 1.4, 1e-9) << id;
  }
}

TEST(FloorFromLines, FollowsTheUnitOfTheScene) {
  Random random = seeded_random(72);
  LineScene scene = corridor_lines();
  for (auto* ends : {&scene.from, &scene.to})
    for (Eigen::Vector3d& p : *ends) p *= 0.2;
  const auto floor = floor_from_lines(scene.camera, SE3(), placed(scene, SE3(), 1e-4, random), {});
  ASSERT_TRUE(floor.outcome) << floor.outcome.reason;
  EXPECT_NEAR(floor.height, 0.28, 0.004);
}

TEST(FloorFromLines, SaysNothingOfACeiling) {
  Random random = seeded_random(73);
  const LineScene whole = corridor_lines();
  LineScene above;
  for (std::size_t i = 0; i < whole.from.size(); ++i)
    if (std::max(whole.from[i].y(), whole.to[i].y()) < 0) {
      above.from.push_back(whole.from[i]);
      above.to.push_back(whole.to[i]);
    }
  EXPECT_EQ(
      floor_from_lines(above.camera, SE3(), placed(above, SE3(), 1e-3, random), {}).outcome.code,
      Code::kNoConsensus);
}

TEST(FloorFromLines, SharedDirectionsStraightenLinesThatLean) {
  // Placed from near views with the way between them off, all uprights lean the same way; where the
  // floor is seen metres ahead that is a height.
  Random random = seeded_random(74);
  const LineScene scene = corridor_lines();
  std::vector<PlacedLine> lines = placed(scene, SE3(), 1e-3, random);
  std::erase_if(lines, [&](const PlacedLine& line) {  // nothing along the way is ever placed
    return std::abs(line.line_ref.direction().z()) > 0.9;
  });
  for (PlacedLine& line : lines)
    if (std::abs(line.line_ref.direction().y()) > 0.9) {
      const auto i = static_cast<std::size_t>(line.id.value());
      const Eigen::Vector3d foot =
          scene.from[i].y() > scene.to[i].y() ? scene.from[i] : scene.to[i];
      line.line_ref = Line3::from_direction(foot, Eigen::Vector3d(0, 1, 0.05).normalized());
    }
  const auto alone = floor_from_lines(scene.camera, SE3(), lines, {});
  const auto held =
      floor_from_lines(scene.camera, SE3(), lines, {},
                       {{Eigen::Vector3d::UnitY(), 2e-3}, {Eigen::Vector3d::UnitZ(), 2e-3}});
  ASSERT_TRUE(held.outcome) << held.outcome.reason;
  EXPECT_NEAR(held.height, 1.4, 0.03);
  EXPECT_GT(held.down_ref.y(), std::cos(0.01));
  EXPECT_TRUE(!alone.outcome || alone.down_ref.y() < held.down_ref.y());
}

TEST(FloorFromLines, NeedsAVertical) {
  EXPECT_EQ(floor_from_lines(corridor_lines().camera, SE3(), {}, {}).outcome.code,
            Code::kTooFewData);
}

}  // namespace floor_from_lines_test
}  // namespace placegraph
