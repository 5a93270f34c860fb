#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/street_map.h>

#include <cmath>

namespace placegraph {
namespace street_map_test {

const std::vector<std::string> kClasses = {"Road", "Building", "Tree"};

/// `count` points at one spot that are of the classes as `shares` say.
KeyframeStreetPoints observation_of(const Eigen::Vector3f& at, const std::vector<float>& shares,
                                    int count = 8, float height_m = 0) {
  KeyframeStreetPoints observation;
  observation.shares = shares;
  for (int i = 0; i < count; ++i) observation.points.push_back({at, 0, height_m, 0});
  return observation;
}

StreetGridOptions exact() {
  StreetGridOptions options;
  options.cell_m = 0.5;
  options.observation_weight = 1;
  options.min_observations = 1;
  options.min_weight = 1;
  options.min_confidence = 0;
  return options;
}

TEST(StreetGrid, AddsUpLogOddsOfObservations) {
  StreetGrid grid(exact(), kClasses, SO3());
  grid.add(observation_of({0.1F, 0, 5}, {0.5F, 0.3F, 0.2F}), SE3());
  grid.add(observation_of({0.1F, 0, 5}, {0.2F, 0.6F, 0.2F}), SE3());
  const StreetMap map = grid.map();
  ASSERT_EQ(map.cells.size(), 1U);
  // log p - log(1/3), twice; by hand.
  EXPECT_NEAR(map.log_odds[0], std::log(0.5 * 3) + std::log(0.2 * 3), 1e-5);
  EXPECT_NEAR(map.log_odds[1], std::log(0.3 * 3) + std::log(0.6 * 3), 1e-5);
  const double sum = 0.5 * 0.2 + 0.3 * 0.6 + 0.2 * 0.2;
  EXPECT_EQ(map.cells[0].label, 1);
  EXPECT_NEAR(map.cells[0].confidence, 0.18 / sum, 1e-5);
  EXPECT_EQ(map.cells[0].observations, 2);
  EXPECT_NEAR(map.cells[0].weight, 16, 1e-5);
}

TEST(StreetGrid, ManyPointsOfOneObservationCountOnce) {
  StreetGrid grid(exact(), kClasses, SO3());
  grid.add(observation_of({0.1F, 0, 5}, {0.5F, 0.3F, 0.2F}, 1000), SE3());
  EXPECT_NEAR(grid.map().log_odds[0], std::log(0.5 * 3), 1e-4);
}

TEST(StreetGrid, UncertainPointsCountLessAndFarOnesNot) {
  StreetGridOptions options = exact();
  options.max_sigma_m = 1;
  StreetGrid grid(options, kClasses, SO3());
  KeyframeStreetPoints observation = observation_of({0.1F, 0, 5}, {1, 0, 0}, 1);
  observation.points[0].sigma = 0.5F;  // as large as a cell: half
  grid.add(observation, SE3());
  EXPECT_NEAR(grid.map().cells[0].weight, 0.5, 1e-6);
  observation.points[0].sigma = 1.1F;
  grid.add(observation, SE3());
  EXPECT_EQ(grid.map().cells[0].observations, 1);
}

TEST(StreetGrid, CallsACellUnknownThatWasSeenTooLittle) {
  StreetGridOptions options = exact();
  options.min_observations = 2;
  StreetGrid grid(options, kClasses, SO3());
  grid.add(observation_of({0.1F, 0, 5}, {1, 0, 0}), SE3());
  EXPECT_FALSE(grid.map().cells[0].label);
  grid.add(observation_of({0.1F, 0, 5}, {1, 0, 0}), SE3());
  EXPECT_EQ(grid.map().cells[0].label, 0);
  options.min_observations = 1;
  options.min_confidence = 0.6;
  StreetGrid doubting(options, kClasses, SO3());
  doubting.add(observation_of({0.1F, 0, 5}, {0.5F, 0.5F, 0}), SE3());
  EXPECT_FALSE(doubting.map().cells[0].label);
}

TEST(StreetGrid, PlacesPointsByThePoseAndTheRotationOfThePlan) {
  // The plan's y is the map's -z.
  Eigen::Matrix3d R;
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  StreetGrid grid(exact(), kClasses, SO3::from_matrix(R));
  grid.add(observation_of({0.25F, 0, 5}, {1, 0, 0}, 4, 0.2F),
           SE3(SO3(), Eigen::Vector3d(1, 2.25, -0.1)));
  const StreetCell cell = grid.map().cells.at(0);
  EXPECT_NEAR((cell.mean - Eigen::Vector3f(1.25F, -4.9F, 2.25F)).norm(), 0, 1e-5);
  EXPECT_EQ(cell.at, Eigen::Vector3i(2, -10, 4));
  EXPECT_NEAR(cell.height_m, 0.2, 1e-6);
}

TEST(StreetGrid, RefusesWhatItCannotPlace) {
  StreetGrid grid(exact(), kClasses, SO3());
  KeyframeStreetPoints observation = observation_of({0, 0, 5}, {1, 0, 0});
  observation.points[3].region = 1;
  EXPECT_THROW(grid.add(observation, SE3()), ArgumentError);
  EXPECT_THROW(StreetGrid({}, {"Road"}, SO3()), ArgumentError);
  EXPECT_FALSE(StreetGrid({}, kClasses, SO3()).map().outcome);
}

TEST(TopView, ShowsWhatStandsOverTheGround) {
  StreetGrid grid(exact(), kClasses, SO3());
  grid.add(observation_of({0.1F, 1.6F, 5}, {1, 0, 0}, 20, 0), SE3());
  grid.add(observation_of({0.1F, -2, 5}, {0, 0, 1}, 20, 3.6F), SE3());
  grid.add(observation_of({0.7F, 1.6F, 5}, {1, 0, 0}, 40, 0), SE3());
  grid.add(observation_of({0.7F, -2, 5}, {0, 1, 0}, 2, 3.6F), SE3());  // too little to stand
  const StreetMap map = grid.map();
  const TopView view = top_view(map);
  ASSERT_EQ(view.columns, 2);
  ASSERT_EQ(view.rows, 1);
  EXPECT_EQ(map.cells[static_cast<std::size_t>(view.at(0, 0))].label, 2);
  EXPECT_EQ(map.cells[static_cast<std::size_t>(view.at(1, 0))].label, 0);
}

}  // namespace street_map_test
}  // namespace placegraph
