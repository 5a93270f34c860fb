#include "apps/results/environment_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace placegraph::apps {
namespace environment_files_test {

using ::testing::HasSubstr;

TEST(EnvironmentFiles, ALineHasAColumnForEverything) {
  EnvironmentObservation measured, undecided;
  measured.frame = FrameId(12);
  measured.evidence.values.fill(0.5);
  measured.evidence.values[1] = std::numeric_limits<double>::quiet_NaN();
  measured.probabilities = {0.5, 0.25, 0.125, 0.0625, 0.0625};
  measured.kind = Environment::kRoom;
  undecided.frame = FrameId(13);
  const std::string csv = environment_csv({measured, undecided});
  const auto count = std::ranges::count(csv.substr(0, csv.find('\n')), ',');
  EXPECT_EQ(static_cast<std::size_t>(count),
            evidence_names().size() + static_cast<std::size_t>(kEnvironmentCount) + 1);
  EXPECT_EQ(std::ranges::count(csv, ','), 3 * count);
  EXPECT_THAT(csv, HasSubstr(",p_street,p_road,p_corridor,p_room,p_hall,kind\n12,0.5,,0.5,"));
  EXPECT_THAT(csv, HasSubstr(",0.500,0.250,0.125,0.062,0.062,room\n13,,"));
  EXPECT_TRUE(csv.ends_with(",unknown\n"));
}

TEST(EnvironmentFiles, EveryPlaceIsCountedOnce) {
  PlaceGraph graph;
  graph.places.resize(6);
  for (const std::size_t i : {0U, 2U, 5U}) label_environment(graph.places[i], Environment::kHall);
  label_environment(graph.places[1], Environment::kRoad);
  graph.places[3].labels = {"kitchen"};
  EXPECT_EQ(
      describe_environments(graph),
      (nlohmann::json{
          {"street", 0}, {"road", 1}, {"corridor", 0}, {"room", 0}, {"hall", 3}, {"unknown", 2}}));
}

}  // namespace environment_files_test
}  // namespace placegraph::apps
