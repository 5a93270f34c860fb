#include <gtest/gtest.h>
#include <placegraph/graph/scene/environment.h>

namespace placegraph {
namespace environment_test {

TEST(Environment, HasANameForEveryKindThatLeadsBackToIt) {
  for (int k = 0; k < kEnvironmentCount; ++k) {
    const auto kind = static_cast<Environment>(k);
    EXPECT_EQ(environment_of_name(environment_name(kind)), kind);
  }
  EXPECT_FALSE(environment_of_name("unknown"));
}

TEST(Environment, LabelsAPlaceOnceAndLeavesItsOtherLabels) {
  Place place;
  place.labels = {"room 3"};
  EXPECT_FALSE(environment_of(place));
  label_environment(place, Environment::kRoom);
  label_environment(place, Environment::kCorridor);
  EXPECT_EQ(place.labels, (std::vector<std::string>{"room 3", "environment:corridor"}));
  EXPECT_EQ(environment_of(place), Environment::kCorridor);
}

TEST(Environment, TrustsLabelsOfStreetsOutdoorsOnly) {
  EXPECT_TRUE(assumptions_of(Environment::kStreet).street_surfaces);
  EXPECT_TRUE(assumptions_of(Environment::kRoad).street_surfaces);
  EXPECT_FALSE(assumptions_of(Environment::kCorridor).street_surfaces);
  EXPECT_FALSE(assumptions_of(Environment::kRoom).ground_height);
  EXPECT_TRUE(assumptions_of(Environment::kHall).manhattan_frame);
}

}  // namespace environment_test
}  // namespace placegraph
