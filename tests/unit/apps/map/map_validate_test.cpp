#include "apps/map/map_validate.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace map_validate_test {

using test::message_of;
using testing::HasSubstr;

class MapValidateCommand : public testing::Test {
 protected:
  MapValidateCommand() {
    Random random(3);
    stored = test::random_map(random);
    arguments.map = folder.path();
  }
  std::string complaint() {
    write_map(folder / "map.db", stored);
    return message_of([&] { map_validate(arguments); });
  }
  test::TemporaryFolder folder;
  StoredMap stored;
  MapValidateArguments arguments;
};

TEST_F(MapValidateCommand, PassesAWholeMap) {
  write_map(folder / "map.db", stored);
  const MapValidateResult result = map_validate(arguments);
  EXPECT_EQ(result.map, folder / "map.db");
  EXPECT_EQ(result.finished, stored.finished);
  EXPECT_EQ(result.places, 4u);
  EXPECT_EQ(result.frames, stored.map.frames.size());
}

TEST_F(MapValidateCommand, PassesAMapWhoseRunWasBrokenOff) {
  stored.finished = false;
  write_map(folder / "map.db", stored);
  EXPECT_FALSE(map_validate(arguments).finished);
}

TEST_F(MapValidateCommand, FindsAKeyframeOfAFrameThatIsNotThere) {
  stored.map.keyframes[2].frame = FrameId(1'000'000);
  EXPECT_EQ(complaint(),
            (folder / "map.db") + ": table keyframe, row 2: frame 1000000 is no frame of the map");
}

TEST_F(MapValidateCommand, FindsALoopOfAFrameThatIsNotThere) {
  stored.map.loops[1].query_frame = FrameId(1'000'000);
  EXPECT_EQ(complaint(), (folder / "map.db") +
                             ": table loop, row 1: frames 1000000 and 2 are not both of the map");
}

TEST_F(MapValidateCommand, FindsThatARunCouldNotGoOn) {
  stored.history.founded = 0;  // the next place would get the number of one that is there
  EXPECT_THAT(
      complaint(),
      HasSubstr("map.db: tables link, part, place: PlacePartition: fewer places were founded "));
}

TEST_F(MapValidateCommand, FindsThatTheFileIsDamaged) {
  write_map(folder / "map.db", stored);
  std::string bytes = test::read_file(folder / "map.db");
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 8192; ++i) bytes[i] = '\x5a';
  folder.write("map.db", bytes);
  EXPECT_THAT(message_of([&] { map_validate(arguments); }), HasSubstr("map.db: is damaged: "));
}

TEST(MapValidateText, IsOneLine) {
  const MapValidateResult result{"out/map.db", true, 4, 40};
  EXPECT_EQ(to_text(result), "out/map.db: valid, finished, 4 places, 40 frames\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["frames"], 40);
  EXPECT_EQ(to_text(MapValidateResult{"m.db", false, 1, 2}),
            "m.db: valid, broken off, 1 places, 2 frames\n");
}

}  // namespace map_validate_test
}  // namespace placegraph::apps
