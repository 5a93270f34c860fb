#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/wall_profile.h>

#include <algorithm>

namespace placegraph {
namespace wall_profile_test {

constexpr DoorShape kDoor{
    .max_width_m = 2.2, .min_head_m = 1.8, .min_recess_m = 0.025, .max_recess_m = 0.16};
constexpr double kOffset_m = 3, kDoorFrom_m = 2.5, kDoorTo_m = 3.4, kHead_m = 2.05;

/// A wall from 1 to 5 m along one of the four sides, with a doorway in it. `behind_m`: of the
/// surface from where the plane is taken to be; `leaf_m`: of a closed leaf behind the surface.
struct Wall {
  int axis, sign;
  double behind_m = 0;
  std::optional<double> leaf_m{};

  WallPlane plane() const { return {axis, sign, kOffset_m, 1, 5}; }
  /// `before_m`: in front of the plane, to the side that it is seen from.
  Eigen::Vector3d at(double along_m, double before_m, double height_m) const {
    Eigen::Vector3d p;
    p[1 - axis] = along_m, p[axis] = kOffset_m + sign * before_m, p[2] = height_m;
    return p;
  }
  static bool in_doorway(double along_m, double height_m) {
    return along_m > kDoorFrom_m && along_m < kDoorTo_m && height_m < kHead_m;
  }
  std::vector<PlacedPoint> points() const {
    std::vector<PlacedPoint> points;
    const Eigen::Vector3d normal = at(0, 1, 0) - at(0, 0, 0);
    for (double s = 1; s < 5; s += 0.02)
      for (double z = 0.35; z < 2.45; z += 0.1) {
        if (in_doorway(s, z) && !leaf_m) continue;
        const double behind = behind_m + (in_doorway(s, z) ? *leaf_m : 0);
        points.push_back({at(s, -behind, z).cast<float>(), normal.cast<float>(), 0.01F, 0});
      }
    return points;
  }
  /// Rays from a metre in front, through the doorway if it is open.
  VoxelEvidence voxels() const {
    VoxelEvidence voxels({-2, -2, 0}, {8, 8, 2.6}, 0.05, 0.2);
    for (double s = 1.01; s < 5; s += 0.025)
      for (double z = 0.1; z < 2.6; z += 0.2) {
        const bool through = in_doorway(s, z) && !leaf_m;
        for (int k = 0; k < 3; ++k)
          voxels.add_ray(at(s, 1, z), at(s, through ? -1 : -behind_m, z), 0, true);
      }
    return voxels;
  }
  WallProfile profile(const std::vector<Eigen::Vector3d>& path = {}) const {
    return profile_wall(plane(), points(), voxels(), path, kDoor);
  }
};

/// The steps that lie between two places of a profile.
std::vector<WallStep> between(const WallProfile& profile, double from_m, double to_m) {
  std::vector<WallStep> steps;
  for (std::size_t i = 0; i < profile.steps.size(); ++i)
    if (profile.at_m(i) >= from_m && profile.at_m(i + 1) <= to_m) steps.push_back(profile.steps[i]);
  return steps;
}

class WallProfileOfSide : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  Wall wall() const { return {GetParam().first, GetParam().second}; }
};
INSTANTIATE_TEST_SUITE_P(Sides, WallProfileOfSide,
                         testing::Values(std::pair(0, -1), std::pair(0, 1), std::pair(1, -1),
                                         std::pair(1, 1)));

// Points count for the steps beside theirs too: what is about an edge is not looked at.

TEST_P(WallProfileOfSide, ShowsWallAndAnOpenDoorway) {
  const WallProfile profile = wall().profile();
  for (const auto& [from, to] : {std::pair(1.1, kDoorFrom_m - 0.1), {kDoorTo_m + 0.1, 4.9}}) {
    const auto steps = between(profile, from, to);
    ASSERT_GT(steps.size(), 20U);
    for (const WallStep& step : steps) {
      EXPECT_TRUE(step.wall);
      EXPECT_FALSE(step.recess);
      EXPECT_FALSE(step.open);
      EXPECT_TRUE(step.faced);
    }
  }
  const auto doorway = between(profile, kDoorFrom_m + 0.1, kDoorTo_m - 0.1);
  ASSERT_GT(doorway.size(), 10U);
  for (const WallStep& step : doorway) {
    EXPECT_FALSE(step.wall);
    EXPECT_FALSE(step.recess);
    EXPECT_TRUE(step.open);
    EXPECT_TRUE(step.faced);
    EXPECT_FALSE(step.over);
    ASSERT_TRUE(step.head.has_value());
    EXPECT_NEAR(*step.head, kHead_m, 0.11);  // points are 0.1 m apart
  }
}

TEST_P(WallProfileOfSide, ShowsALeafBehindTheSurface) {
  Wall closed = wall();
  closed.leaf_m = 0.08;
  const auto doorway = between(closed.profile(), kDoorFrom_m + 0.1, kDoorTo_m - 0.1);
  ASSERT_GT(doorway.size(), 10U);
  for (const WallStep& step : doorway) {
    EXPECT_TRUE(step.recess);
    EXPECT_FALSE(step.wall);
    EXPECT_FALSE(step.open);
  }
  closed.leaf_m = 0.01;  // not set back: the wall goes on
  for (const WallStep& step : between(closed.profile(), kDoorFrom_m + 0.1, kDoorTo_m - 0.1))
    EXPECT_TRUE(step.wall);
}

TEST_P(WallProfileOfSide, TellsLeavesFromASurfaceThatDriftHasBent) {
  Wall bent = wall();
  bent.behind_m = 0.05;
  bent.leaf_m = 0.06;
  const WallProfile profile = bent.profile();
  for (const WallStep& step : between(profile, 1.1, kDoorFrom_m - 0.1)) {
    EXPECT_TRUE(step.wall);
    EXPECT_NEAR(step.behind_m, 0.05, 1e-6);
  }
  for (const WallStep& step : between(profile, kDoorFrom_m + 0.1, kDoorTo_m - 0.1))
    EXPECT_TRUE(step.recess);
}

TEST_P(WallProfileOfSide, KnowsNothingBeyondItsEnds) {
  const WallProfile profile = wall().profile();
  EXPECT_NEAR(profile.at_m(0), 1 - kDoor.max_width_m, 1e-12);
  EXPECT_GE(profile.at_m(profile.steps.size()), 5 + kDoor.max_width_m - 1e-9);
  for (const auto& [from, to] : {std::pair(-5.0, 0.8), {5.2, 20.0}})
    for (const WallStep& step : between(profile, from, to))
      EXPECT_FALSE(step.wall || step.recess || step.open || step.faced || step.head);
}

TEST_P(WallProfileOfSide, RemembersWhereTheCameraWentThrough) {
  const Wall wall_of_side = wall();
  // Through at a quarter of the way from 2.5 to 3.3 m, then along, then back by a jump that no
  // camera makes.
  const WallProfile profile =
      wall_of_side.profile({wall_of_side.at(2.5, 0.3, 1), wall_of_side.at(3.3, -0.9, 1),
                            wall_of_side.at(4, -0.9, 1), wall_of_side.at(4, 3, 1)});
  ASSERT_EQ(profile.crossed_m.size(), 1U);
  EXPECT_NEAR(profile.crossed_m[0], 2.7, 1e-9);
  const auto step_at = [&](double along_m) {
    return static_cast<std::size_t>((along_m - profile.from_m) / WallProfile::kStep_m + 1e-6);
  };
  EXPECT_TRUE(profile.crossed(step_at(2.6), step_at(2.8)));
  EXPECT_FALSE(profile.crossed(step_at(2.8), step_at(3.5)));
  EXPECT_FALSE(profile.crossed(step_at(2.0), step_at(2.6)));
}

TEST(PlanesOf, JoinsPiecesOfOneSideThatLieInOnePlane) {
  const auto piece = [](int axis, int sign, double offset_m, double from_m, double to_m) {
    WallPiece p;
    p.axis = axis, p.sign = sign, p.offset_m = offset_m, p.from_m = from_m, p.to_m = to_m;
    return p;
  };
  const auto count = [&](const WallPiece& other) {
    return planes_of({piece(0, 1, 3, 1, 4), other}, 2).size();
  };
  EXPECT_EQ(count(piece(0, 1, 3.05, 5, 6)), 1U);
  EXPECT_EQ(count(piece(0, 1, 3.05, 6.1, 7)), 2U);  // too far along
  EXPECT_EQ(count(piece(0, 1, 3.15, 5, 6)), 2U);    // another offset
  EXPECT_EQ(count(piece(0, -1, 3, 5, 6)), 2U);      // the other side
  EXPECT_EQ(count(piece(1, 1, 3, 5, 6)), 2U);       // another axis
  const auto planes = planes_of({piece(0, 1, 3.05, 5, 6), piece(0, 1, 3, 1, 4)}, 2);
  EXPECT_EQ(planes.front().offset_m, 3);  // the longer one's
  EXPECT_EQ(planes.front().from_m, 1);
  EXPECT_EQ(planes.front().to_m, 6);
}

}  // namespace wall_profile_test
}  // namespace placegraph
