#include "apps/train/train_environment.h"

#include <gtest/gtest.h>
#include <placegraph/frontend/scene/environment.h>
#include <placegraph/graph/core/error.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/support/message_of.h"
#include "tests/unit/apps/image/scene/drawn_set.h"

namespace placegraph::apps {
namespace train_environment_test {

using test::message_of;
using testing::HasSubstr;

int sum(const std::array<int, kEnvironmentCount>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0);
}

class TrainEnvironmentCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() { models = new test::DrawnModels; }
  static void TearDownTestSuite() { delete models; }
  TrainEnvironmentCommand() {
    arguments.out = folder / "environment.txt";
    arguments.model = models->folder / "surfaces.pgscene";
    arguments.seeds = {1};
    arguments.left_out = {};
    arguments.frames = 1;
  }
  static test::DrawnModels* models;
  test::TemporaryFolder folder;
  TrainEnvironmentArguments arguments;
};
test::DrawnModels* TrainEnvironmentCommand::models = nullptr;

TEST_F(TrainEnvironmentCommand, LearnsFromAStreetAndFromRooms) {
  const TrainEnvironmentResult result = train_environment(arguments);
  const auto street = static_cast<std::size_t>(Environment::kStreet);
  EXPECT_EQ(result.training_set.views[street], 1);
  EXPECT_GT(sum(result.training_set.views), 2);
  // So few views are told apart easily.
  EXPECT_GE(sum(result.training_set.right), sum(result.training_set.views) - 1);
  EXPECT_EQ(sum(result.left_out.views), 0);
  const EnvironmentModel model = parse_environments(test::read_file(arguments.out), arguments.out);
  EXPECT_NE(model.weights[street], decltype(EnvironmentModel::weights){}[street]);
}

TEST_F(TrainEnvironmentCommand, JudgesWorldsThatWereLeftOut) {
  arguments.left_out = {1};  // the same again
  const TrainEnvironmentResult result = train_environment(arguments);
  EXPECT_EQ(result.left_out.views, result.training_set.views);
  EXPECT_EQ(result.left_out.right, result.training_set.right);
}

TEST_F(TrainEnvironmentCommand, NamesWhatIsMissing) {
  arguments.model = folder / "none.pgscene";
  EXPECT_THAT(message_of([&] { train_environment(arguments); }),
              HasSubstr("none.pgscene: no such model; "));
  arguments.model = models->folder / "urban.pgscene";
  EXPECT_THAT(message_of([&] { train_environment(arguments); }),
              HasSubstr("urban.pgscene: a model of kind urban, and surfaces is needed"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST(TrainEnvironmentText, HasALineForEveryKindThatOccurs) {
  TrainEnvironmentResult result;
  result.out = "e.txt";
  result.training_set.views = {30, 0, 12, 0, 0};
  result.training_set.right = {29, 0, 12, 0, 0};
  result.left_out.views = {0, 0, 0, 7, 0};
  result.left_out.right = {0, 0, 0, 5, 0};
  EXPECT_EQ(to_text(result),
            "training  street      29 of   30 correct\n"
            "training  corridor    12 of   12 correct\n"
            "test      room         5 of    7 correct\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["lesson"]["street"], nlohmann::json({{"views", 30}, {"right", 29}}));
  EXPECT_EQ(json["left_out"].size(), 1u);
}

}  // namespace train_environment_test
}  // namespace placegraph::apps
