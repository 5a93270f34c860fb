#include "apps/train/train_planarity.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace train_planarity_test {

using test::message_of;
using testing::HasSubstr;

class TrainPlanarityCommand : public testing::Test {
 protected:
  TrainPlanarityCommand() {
    arguments.out = folder / "planarity.txt";
    arguments.clouds = 16;
    arguments.frames = 0;
    arguments.rounds = 10;
  }
  test::TemporaryFolder folder;
  TrainPlanarityArguments arguments;
};

TEST_F(TrainPlanarityCommand, LeavesEveryFourthCloudOutAndJudgesIt) {
  const TrainPlanarityResult result = train_planarity(arguments);
  EXPECT_EQ(result.trained.clouds, 12);
  EXPECT_EQ(result.left_out.clouds, 4);
  for (const PlanarityScore& score : {result.trained, result.left_out}) {
    EXPECT_GT(score.planes, 0);
    EXPECT_EQ(score.segments, score.planes + score.others);
    EXPECT_EQ(score.right, score.planes_kept + score.others - score.others_kept);
  }
  EXPECT_GT(result.trained.right, 0.9 * result.trained.segments);
  EXPECT_TRUE(std::filesystem::exists(arguments.out));
}

TEST_F(TrainPlanarityCommand, IsTheSameForTheSameSeedAlone) {
  arguments.clouds = 10;
  train_planarity(arguments);
  const std::string model = test::read_file(arguments.out);
  arguments.force = true;
  train_planarity(arguments);
  EXPECT_EQ(test::read_file(arguments.out), model);
  arguments.seed = 2;
  train_planarity(arguments);
  EXPECT_NE(test::read_file(arguments.out), model);
}

TEST_F(TrainPlanarityCommand, LearnsFromRenderedWorldsToo) {
  const TrainPlanarityResult without = train_planarity(arguments);
  arguments.worlds = {"corridor-loop"};
  arguments.frames = 2;
  arguments.force = true;
  const TrainPlanarityResult with = train_planarity(arguments);
  EXPECT_EQ(with.trained.clouds, 14);
  EXPECT_GT(with.trained.planes, without.trained.planes);
  EXPECT_EQ(with.left_out.segments, without.left_out.segments);
}

TEST_F(TrainPlanarityCommand, RefusesTooFewCloudsAndAFileThatIsThere) {
  arguments.clouds = 9;
  EXPECT_THAT(message_of<ArgumentError>([&] { train_planarity(arguments); }),
              HasSubstr("--clouds: fewer than 10"));
  arguments.clouds = 16;
  folder.write("planarity.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { train_planarity(arguments); }),
              HasSubstr("planarity.txt: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
}

TEST(TrainPlanarityText, CountsTheRightPredictions) {
  const TrainPlanarityResult result{
      "p.txt", {12, 200, 190, 150, 145, 50, 5}, {4, 0, 0, 0, 0, 0, 0}};
  EXPECT_EQ(to_text(result),
            "200 segments of 12 clouds, 150 of them planes, 95.0 % correct\n"
            "test: 0 segments of 4 clouds, 0.0 % correct; kept: 0.0 % of the planes, 0.0 % of "
            "the others\n");
  TrainPlanarityResult swapped{"p.txt", result.left_out, result.trained};
  const auto json = nlohmann::json::parse(to_json(swapped));
  EXPECT_EQ(json["clouds"], 4);
  EXPECT_EQ(json["left_out"]["planes_kept"], 145.0 / 150);
  EXPECT_EQ(json["left_out"]["others_kept"], 0.1);
}

}  // namespace train_planarity_test
}  // namespace placegraph::apps
