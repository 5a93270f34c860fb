#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/render/road_field.h>

namespace placegraph::synthetic {
namespace road_field_test {

Roadway straight(double x, double length) {
  Roadway roadway;
  for (double z = 0; z <= length; z += 2) roadway.centre.emplace_back(x, z);
  return roadway;
}

TEST(RoadField, MeasuresFromTheAsphaltsEdgeNegativeOnTheRoad) {
  const RoadField field({straight(0, 100)});
  EXPECT_NEAR(field.edge_distance(0.0, 50), -4, 1e-5);
  EXPECT_NEAR(field.edge_distance(3.3, 50.4), -0.7, 1e-5);
  EXPECT_NEAR(field.edge_distance(-9.0, 20), 5, 1e-5);
  EXPECT_NEAR(field.edge_distance(500, 500), RoadField::kReach_m, 1e-5);
}

TEST(RoadField, PutsRightOfTheDrivingDirectionAtPositiveLateral) {
  const RoadField field({straight(0, 100)});
  const RoadField::Sample right = field.sample(2.5, 40.5), left = field.sample(-2.5, 40.5);
  ASSERT_TRUE(right.marked);
  ASSERT_TRUE(left.marked);
  EXPECT_NEAR(right.lateral, 2.5, 1e-4);
  EXPECT_NEAR(left.lateral, -2.5, 1e-4);
  EXPECT_NEAR(right.along, 40.5, 1e-4);
}

TEST(RoadField, HasNoMarkingsWhereTwoRoadsMeet) {
  const RoadField field({straight(0, 100), straight(30, 100)});
  EXPECT_TRUE(field.sample(14.2, 50).marked);
  EXPECT_FALSE(field.sample(15.0, 50.5).marked && field.sample(14.6, 50.5).marked);
}

TEST(RoadField, RefusesAnExtentThatNoDriveHas) {
  EXPECT_THROW(RoadField({straight(0, 10), straight(1e6, 10)}), ArgumentError);
  EXPECT_THROW(RoadField({}), ArgumentError);
}

}  // namespace road_field_test
}  // namespace placegraph::synthetic
