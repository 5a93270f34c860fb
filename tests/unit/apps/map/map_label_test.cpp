#include "apps/map/map_label.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>

#include "apps/map/map_learn.h"
#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/unit/apps/map/walked_rooms.h"

namespace placegraph::apps {
namespace map_label_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A map of a walk through two rooms, and another walk through them whose images have labels.
class MapLabelCommand : public testing::Test {
 protected:
  MapLabelCommand() {
    test::write_walk(folder, "walk", 2, 12);
    MapLearnArguments learning;
    learning.images = folder / "walk";
    learning.out = arguments.map = folder / "walk.db";
    map_learn(learning);
    test::write_walk(folder, "rooms", 2, 12, 2, 7);
    std::string labels;
    for (int i = 0; i < 24; ++i) labels += std::to_string(i) + " " + std::to_string(i / 12) + "\n";
    folder.write("rooms/labels.txt", labels);
    arguments.house = folder / "rooms";
  }
  test::TemporaryFolder folder;
  MapLabelArguments arguments;
};

TEST_F(MapLabelCommand, LabelsThePlacesByTheRoomsTheyLookLike) {
  arguments.names = folder.write("names.txt", "kitchen\nhall\n");
  const MapLabelResult result = map_label(arguments);
  EXPECT_EQ(result.views, 24u);
  EXPECT_EQ(result.labelled, result.places);
  EXPECT_GT(result.accuracy, 0.9);
  const StoredMap stored = read_map(arguments.map);
  ASSERT_EQ(result.list.size(), stored.map.place_graph.places.size());
  for (const Keyframe& keyframe : stored.map.keyframes) {
    const std::string room = keyframe.frame < FrameId(12) ? "kitchen" : "hall";
    EXPECT_EQ(stored.map.place_graph.find(keyframe.place)->labels, std::vector<std::string>{room});
  }
  for (const json& place : result.list) EXPECT_GT(place["probability"], 0.5);
}

TEST_F(MapLabelCommand, LabelsAreNumbersWithoutNamesAndNothingWhereNoneIsSure) {
  EXPECT_EQ(map_label(arguments).list.front()["label"], "0");
  arguments.options.min_probability = 1;
  const MapLabelResult unsure = map_label(arguments);
  EXPECT_EQ(unsure.labelled, 0u);
  EXPECT_TRUE(unsure.list.front()["label"].is_null());
  EXPECT_TRUE(read_map(arguments.map).map.place_graph.places.front().labels.empty());
}

TEST_F(MapLabelCommand, NamesTheFileAndThePlaceOfWhatIsWrong) {
  arguments.names = folder.write("names.txt", "kitchen\n");
  EXPECT_THAT(message_of<ArgumentError>([&] { map_label(arguments); }),
              HasSubstr("--names: 1 names for 2 labels"));
  folder.write("names.txt", "kitchen\n\nhall\n");
  EXPECT_THAT(message_of([&] { map_label(arguments); }), HasSubstr("names.txt:2: an empty name"));
  folder.write("rooms/labels.txt", "99 0\n");
  EXPECT_THAT(message_of([&] { map_label(arguments); }),
              HasSubstr("labels.txt: labels none of the images"));
}

TEST_F(MapLabelCommand, RefusesAMapThatIsNotFinishedAndOneWhoseImagesAreGone) {
  std::filesystem::remove(folder / "walk/000023.png");
  EXPECT_THAT(message_of([&] { map_label(arguments); }),
              HasSubstr("has 23 images, and keyframe 23 of the map is of image 23"));
  StoredMap stored = read_map(arguments.map);
  stored.finished = false;
  write_map(arguments.map, stored);
  EXPECT_THAT(
      message_of<NoResult>([&] { map_label(arguments); }),
      HasSubstr("walk.db: its run was broken off; finish it with `placegraph run --resume` first"));
}

TEST(MapLabelText, IsOneLine) {
  const MapLabelResult result{"m.db", 3, 4, 50, 0.9, json::array()};
  EXPECT_EQ(to_text(result),
            "m.db: 3 of 4 places labelled (50 views; cross-validated accuracy 0.900)\n");
}

}  // namespace map_label_test
}  // namespace placegraph::apps
