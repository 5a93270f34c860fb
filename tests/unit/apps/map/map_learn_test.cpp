#include "apps/map/map_learn.h"

#include <gtest/gtest.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/graph/core/error.h>

#include <map>
#include <set>

#include "tests/support/message_of.h"
#include "tests/unit/apps/map/walked_rooms.h"

namespace placegraph::apps {
namespace map_learn_test {

using test::message_of;
using testing::HasSubstr;

/// A walk through three rooms, twelve images in each.
class MapLearnCommand : public testing::Test {
 protected:
  MapLearnCommand() {
    test::write_walk(folder, "walk", 3, 12);
    arguments.images = folder / "walk";
    arguments.out = folder / "walk.db";
  }
  test::TemporaryFolder folder;
  MapLearnArguments arguments;
};

TEST_F(MapLearnCommand, EveryRoomHasPlacesOfItsOwn) {
  const MapLearnResult result = map_learn(arguments);
  EXPECT_EQ(result.images, 36u);
  const StoredMap stored = read_map(arguments.out);
  EXPECT_EQ(stored.map.place_graph.places.size(), result.places);
  ASSERT_EQ(stored.map.keyframes.size(), 36u);
  EXPECT_FALSE(stored.origin.calibration);
  EXPECT_EQ(stored.origin.sequence, arguments.images);
  std::map<PlaceId, std::set<std::size_t>> rooms_of;
  for (std::size_t i = 0; i < 36; ++i) {
    EXPECT_EQ(stored.map.keyframes[i].frame, FrameId(i));
    const std::size_t view = i % 12;  // a place may end a view too late
    if (view >= 3) rooms_of[stored.map.keyframes[i].place].insert(i / 12);
  }
  EXPECT_GE(rooms_of.size(), 3u);
  for (const auto& [place, rooms] : rooms_of) EXPECT_EQ(rooms.size(), 1u) << place;
}

TEST_F(MapLearnCommand, KeepsTheNumbersOfTheImagesOfARange) {
  arguments.range = {12, 30};
  EXPECT_EQ(map_learn(arguments).images, 19u);
  const StoredMap stored = read_map(arguments.out);
  EXPECT_EQ(stored.map.keyframes.front().frame, FrameId(12));
  EXPECT_EQ(stored.map.keyframes.back().frame, FrameId(30));
  arguments.range = {12, 36};
  arguments.force = true;
  EXPECT_THAT(message_of<ArgumentError>([&] { map_learn(arguments); }),
              HasSubstr("--range: two numbers of images needed, from 0 to 35"));
}

TEST_F(MapLearnCommand, SettingsAreHeeded) {
  const std::size_t usual = map_learn(arguments).places;
  arguments.force = true;
  arguments.settings = {"alike=0.95"};
  EXPECT_GT(map_learn(arguments).places, usual);
}

TEST_F(MapLearnCommand, NamesTheImageThatIsGreyAmongOthers) {
  test::write_image(folder, "walk/000020.png", Image(120, 160, CV_8UC1, cv::Scalar(90)));
  EXPECT_THAT(message_of([&] { map_learn(arguments); }),
              HasSubstr("000020.png: is grey, and the images before it have colour"));
  folder.write("walk.db", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { map_learn(arguments); }),
              HasSubstr("walk.db: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
}

}  // namespace map_learn_test
}  // namespace placegraph::apps
