#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/wall_fit.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

namespace placegraph {
namespace wall_fit_test {

constexpr double kNoise_m = 0.01;
constexpr WallTolerance kTolerance{
    .band_m = 0.05, .max_rotation_deg = 15, .max_gap_m = 0.3, .max_step_m = 0.07};

/// Points of a wall of one side.
struct WallPoints {
  int axis = 0;
  std::vector<PlacedPoint> points{};

  /// Over its whole height, at `offset_m` in the middle between its ends.
  void add(double from_m, double to_m, double offset_m, double slope, double noise_m = kNoise_m) {
    Random random(points.size() + 3);
    const double middle = 0.5 * (from_m + to_m);
    for (double s = from_m; s <= to_m; s += 0.02)
      for (double z = 0.05; z < 2.5; z += 0.1) {
        PlacedPoint p;
        p.point[1 - axis] = static_cast<float>(s);
        p.point[axis] =
            static_cast<float>(offset_m + slope * (s - middle) + random.normal(0, noise_m));
        p.point[2] = static_cast<float>(z);
        p.sigma = 0.02F;
        points.push_back(p);
      }
  }
  std::vector<const PlacedPoint*> all() const {
    std::vector<const PlacedPoint*> all;
    for (const PlacedPoint& p : points) all.push_back(&p);
    return all;
  }
  WallPiece piece(double from_m, double to_m, double offset_m) const {
    WallPiece piece;
    piece.axis = axis, piece.from_m = from_m, piece.to_m = to_m, piece.offset_m = offset_m;
    return piece;
  }
};

class FitWallOfAxis : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Axes, FitWallOfAxis, testing::Values(0, 1));

TEST_P(FitWallOfAxis, FindsTheLineOfAWallAmongWhatStandsBeforeIt) {
  WallPoints wall{GetParam()};
  wall.add(0, 4, 2, 0.01);
  wall.add(1, 2, 2.08, 0);  // a shelf before a quarter of it
  WallPiece piece = wall.piece(0, 4, 2.01);
  ASSERT_TRUE(fit_wall(wall.all(), kTolerance, piece));
  // Five thousand points of 0.01 m say where it is to less than a millimetre; the shelf pulls a
  // little.
  EXPECT_NEAR(piece.offset_at(2), 2, 0.006);
  EXPECT_NEAR(piece.slope, 0.01, 0.004);
}

TEST_P(FitWallOfAxis, TellsItsExtentHeightAndNumberOfPoints) {
  WallPoints wall{GetParam()};
  wall.add(0.5, 3.5, 2, 0.02, 0.001);
  WallPiece piece = wall.piece(0, 6, 2);
  ASSERT_TRUE(fit_wall(wall.all(), kTolerance, piece));
  EXPECT_NEAR(piece.from_m, 0.5, 0.01);
  EXPECT_NEAR(piece.to_m, 3.5, 0.03);
  EXPECT_NEAR(piece.offset_m, 2, 0.001);  // of the middle of what is seen
  EXPECT_NEAR(piece.low_m, 0.05, 0.11);
  EXPECT_NEAR(piece.high_m, 2.45, 0.11);
  EXPECT_EQ(piece.count, static_cast<int>(wall.points.size()));
}

TEST(FitWall, OfObservationsThatAgreeIsBetterKnown) {
  WallPoints wall;
  wall.add(0, 4, 2, 0);
  WallPiece one = wall.piece(0, 4, 2), sixteen = one;
  ASSERT_TRUE(fit_wall(wall.all(), kTolerance, one));
  for (std::size_t i = 0; i < wall.points.size(); ++i)
    wall.points[i].observation = i % 2 == 0 ? 7 : static_cast<int>(i % 32);
  ASSERT_TRUE(fit_wall(wall.all(), kTolerance, sixteen));
  EXPECT_NEAR(one.sigma_m, std::hypot(0.003, kNoise_m), 0.001);
  // Sixteen odd numbers, 7 among them.
  EXPECT_NEAR(sixteen.sigma_m, std::hypot(0.003, kNoise_m / 4), 0.0005);
  EXPECT_EQ(sixteen.observation, 7);
}

TEST(FitWall, OfAShortPieceDoesNotSlope) {
  WallPoints wall;
  wall.add(0, 1.4, 2, 0.05);
  WallPiece piece = wall.piece(0, 1.4, 2);
  ASSERT_TRUE(fit_wall(wall.all(), kTolerance, piece));
  EXPECT_EQ(piece.slope, 0);
}

TEST(FitWall, FailsWithoutPointsOrWithAWallThatRotates) {
  WallPoints wall;
  wall.add(0, 4, 2, 0);
  WallPiece elsewhere = wall.piece(0, 4, 2.5);
  EXPECT_FALSE(fit_wall(wall.all(), kTolerance, elsewhere));
  for (const auto& [rotation_deg, fits] : {std::pair(12.0, true), {18.0, false}}) {
    WallPoints rotated;
    const double slope = std::tan(rotation_deg * M_PI / 180);
    rotated.add(0, 4, 2, slope);
    WallPiece piece = rotated.piece(0, 4, 2);
    piece.slope = slope;
    EXPECT_EQ(fit_wall(rotated.all(), kTolerance, piece), fits) << rotation_deg;
  }
}

TEST(JoinWalls, JoinsPiecesThatDriftHasPutApart) {
  const auto joined = [](double gap_m, double step_m) {
    WallPoints wall;
    wall.add(0, 2, 2, 0);
    wall.add(2 + gap_m, 3 + gap_m, 2 + step_m, 0);
    std::vector<WallPiece> pieces{wall.piece(0, 2, 2),
                                  wall.piece(2 + gap_m, 3 + gap_m, 2 + step_m)};
    join_walls(wall.all(), kTolerance, pieces);
    return pieces;
  };
  const auto one = joined(0.2, 0.04);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(one[0].from_m, 0, 0.01);
  EXPECT_NEAR(one[0].to_m, 3.2, 0.03);
  EXPECT_NEAR(one[0].offset_at(1.6), 2.015, 0.015);  // between both, nearer to the longer
  EXPECT_EQ(joined(0.4, 0).size(), 2U);              // a gap
  EXPECT_EQ(joined(0.2, 0.1).size(), 2U);            // a step
}

}  // namespace wall_fit_test
}  // namespace placegraph
