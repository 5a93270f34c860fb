#include "apps/map/map_street.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>

#include "apps/support/output.h"
#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/apps/map/posed_map.h"

namespace placegraph::apps {
namespace map_street_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A short drive through a rendered town with two eyes, made once, and its map at true poses.
class MapStreetCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const SyntheticOptions options = test::clean_world("town-loop", 4, 620, 188);
    const SyntheticWorld world(options);
    SequenceWriterOptions writing;
    writing.contents.right = true;
    write_sequence(world, *made / "town", writing);
    write_map(*made / "map.db", test::posed_map(world, *made / "town", Sensor::kStereo, 1));
  }
  static void TearDownTestSuite() { delete made; }
  MapStreetCommand() {
    arguments.map = *made / "map.db";
    arguments.out = folder / "street";
    arguments.settings = {"min_step_m=0.1", "sight.step_px=3"};
  }
  static test::TemporaryFolder* made;
  test::TemporaryFolder folder;
  MapStreetArguments arguments;
};
test::TemporaryFolder* MapStreetCommand::made = nullptr;

TEST_F(MapStreetCommand, SaysWhatIsWhereInAStreet) {
  const MapStreetResult result = map_street(arguments);
  EXPECT_EQ(result.summary["outcome"], "ok");
  EXPECT_EQ(result.summary["keyframes"], 4);
  EXPECT_GT(result.summary["cells"].get<int>(), 100);
  const json written = json::parse(test::read_file(folder / "street/semantic_map.json"));
  EXPECT_FALSE(written["classes"].empty());
  EXPECT_THAT(test::read_file(folder / "street/semantic_map.ply"), testing::StartsWith("ply\n"));
}

TEST_F(MapStreetCommand, SettingsAreHeeded) {
  arguments.settings = {"min_step_m=100", "sight.step_px=3"};
  EXPECT_EQ(map_street(arguments).summary["keyframes"], 1);
}

TEST_F(MapStreetCommand, WritesNothingWhereNothingHasAPose) {
  StoredMap stored = read_map(arguments.map);
  stored.origin.calibration.reset();
  write_map(folder / "images.db", stored);
  arguments.map = folder / "images.db";
  EXPECT_THAT(message_of<NoResult>([&] { map_street(arguments); }),
              HasSubstr("images.db: nothing in it has a pose"));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST_F(MapStreetCommand, NamesWhatIsMissing) {
  arguments.models.urban = folder / "none.pgscene";
  EXPECT_THAT(message_of([&] { map_street(arguments); }),
              HasSubstr("none.pgscene: no such model; "));
  arguments.models.urban.clear();
  arguments.georeference = folder / "earth";
  EXPECT_THAT(message_of([&] { map_street(arguments); }), HasSubstr("earth"));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST(MapStreetText, IsOneLine) {
  const MapStreetResult result{"m.db", "street", {{"cells", 1000}, {"keyframes", 9}}};
  EXPECT_EQ(to_text(result), "m.db: 1000 cells of 9 keyframes; results in street\n");
  EXPECT_EQ(json::parse(to_json(result)), result.summary);
}

}  // namespace map_street_test
}  // namespace placegraph::apps
