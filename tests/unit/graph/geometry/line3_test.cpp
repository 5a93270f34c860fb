#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/line3.h>

#include <cmath>

namespace placegraph {
namespace line3_test {

TEST(Line3, HasMomentAndDirectionOfItsPointsUpToOneFactor) {
  const Eigen::Vector3d point(1, 2, 3), direction(0, 2, 0);
  const Line3 line = Line3::from_direction(point, direction);
  const Line3::Coordinates L = line.coordinates();
  EXPECT_NEAR(L.norm(), 1, 1e-14);
  // p x v = (1, 2, 3) x (0, 1, 0) = (-3, 0, 1)
  EXPECT_LT((L.head<3>() / L.tail<3>().norm() - Eigen::Vector3d(-3, 0, 1)).norm(), 1e-13);
  EXPECT_LT((line.direction() - Eigen::Vector3d(0, 1, 0)).norm(), 1e-14);
  EXPECT_LT((line.nearest_point() - Eigen::Vector3d(1, 0, 3)).norm(), 1e-13);
  EXPECT_NEAR(line.distance_to({1, -7, 5}), 2, 1e-13);
}

TEST(Line3, MayPassThroughTheOrigin) {
  const Line3 line = Line3::from_direction({2, 4, 6}, {1, 2, 3});
  EXPECT_LT(line.nearest_point().norm(), 1e-13);
  EXPECT_LT(line.distance_to({-3, -6, -9}), 1e-12);
}

TEST(Line3, MovesByItsTangentAndMinusUndoesPlus) {
  const Line3 line = Line3::from_direction({1, -2, 3}, {1, 1, 0.5});
  const Line3::Tangent x(0.1, -0.2, 0.05, 0.03);
  EXPECT_LT((line.plus(x).minus(line) - x).norm(), 1e-13);
  Eigen::Matrix<double, 6, 4> J;
  line.coordinates(&J);
  for (int k = 0; k < 4; ++k) {
    const Line3::Tangent step = Line3::Tangent::Unit(k) * 1e-6;
    EXPECT_LT(
        ((line.plus(step).coordinates() - line.plus(-step).coordinates()) / 2e-6 - J.col(k)).norm(),
        1e-9);
  }
}

TEST(Line3, GoesIntoAnotherFrameAsItsPointsDo) {
  const SE3 T_a_b(SO3::exp({0.3, -0.2, 0.5}), Eigen::Vector3d(1, 2, -3));
  const Eigen::Vector3d point(4, 1, 2), direction(0.2, -1, 0.4);
  const Line3::Coordinates L_b = transform_to(T_a_b, Line3::from_direction(point, direction));
  const Line3::Coordinates expected =
      Line3::from_direction(T_a_b.inverse() * point, T_a_b.rotation().inverse() * direction)
          .coordinates();
  EXPECT_LT((L_b.normalized() - expected).norm(), 1e-13);
}

TEST(Line3, IsWhereTwoPlanesMeet) {
  const auto line = meet({1, 0, 0}, 2, {0, 0, 1}, 5);
  ASSERT_TRUE(line);
  EXPECT_LT(line->distance_to({2, 100, 5}), 1e-12);
  EXPECT_LT(line->distance_to({2, -3, 5}), 1e-12);
  EXPECT_FALSE(meet({1, 0, 0}, 2, {-1, 0, 0}, 5));
}

TEST(Line3, RefusesADirectionOfZero) {
  EXPECT_THROW((void)Line3::from_direction({1, 2, 3}, {0, 0, 0}), ArgumentError);
  EXPECT_THROW((void)Line3::from_direction({1, std::nan(""), 3}, {0, 1, 0}), ArgumentError);
}

}  // namespace line3_test
}  // namespace placegraph
