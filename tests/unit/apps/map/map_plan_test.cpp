#include "apps/map/map_plan.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>

#include "apps/support/output.h"
#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/apps/map/posed_map.h"

namespace placegraph::apps {
namespace map_plan_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A walk along a rendered corridor with a depth camera, made once, and its map at true poses.
class MapPlanCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const SyntheticOptions options = test::clean_world("corridor-loop", 40, 160, 120);
    const SyntheticWorld world(options);
    SequenceWriterOptions writing;
    writing.contents.depth = true;
    write_sequence(world, *made / "walk", writing);
    write_map(*made / "map.db", test::posed_map(world, *made / "walk", Sensor::kRgbd, 4));
  }
  static void TearDownTestSuite() { delete made; }
  MapPlanCommand() {
    arguments.map = *made / "map.db";
    arguments.out = folder / "plan";
  }
  static test::TemporaryFolder* made;
  test::TemporaryFolder folder;
  MapPlanArguments arguments;
};
test::TemporaryFolder* MapPlanCommand::made = nullptr;

TEST_F(MapPlanCommand, DrawsTheWallsOfACorridor) {
  const MapPlanResult result = map_plan(arguments);
  EXPECT_GE(result.walls, 2u);
  EXPECT_GE(result.rooms, 1u);
  EXPECT_EQ(result.summary["outcome"], "ok");
  EXPECT_EQ(result.summary["walls"], result.walls);
  // At true poses the walls stand where the building has them.
  EXPECT_LT(result.summary["check"]["origin"]["plan_error_median_m"].get<double>(), 0.1);
  const json written = json::parse(test::read_file(folder / "plan/floor_plan.json"));
  EXPECT_EQ(written["walls"].size(), result.walls);
  EXPECT_TRUE(fs::exists(folder / "plan/floor_plan.svg"));
  EXPECT_TRUE(fs::exists(folder / "plan/floor_plan.png"));
}

TEST_F(MapPlanCommand, WritesNothingWhereNothingHasAPose) {
  StoredMap stored = read_map(arguments.map);
  stored.origin.calibration.reset();
  write_map(folder / "images.db", stored);
  arguments.map = folder / "images.db";
  EXPECT_THAT(message_of<NoResult>([&] { map_plan(arguments); }),
              HasSubstr("images.db: nothing in it has a pose"));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST_F(MapPlanCommand, NamesWhatIsWrong) {
  arguments.settings = {"walls.nothing=1"};
  EXPECT_THAT(message_of<ArgumentError>([&] { map_plan(arguments); }), HasSubstr("walls.nothing"));
  arguments.settings.clear();
  arguments.map = folder / "none.db";
  EXPECT_THAT(message_of([&] { map_plan(arguments); }), HasSubstr("none.db"));
  folder.write("plan/mine.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { map_plan(arguments); }),
              HasSubstr("plan: is not empty; --force writes into it"));
}

TEST(MapPlanText, IsOneLine) {
  const MapPlanResult result{"m.db", "plan", 5, 2, 1, {{"outcome", "ok"}}};
  EXPECT_EQ(to_text(result), "m.db: 5 walls, 2 doors, 1 rooms; results in plan\n");
  EXPECT_EQ(json::parse(to_json(result)), result.summary);
}

}  // namespace map_plan_test
}  // namespace placegraph::apps
