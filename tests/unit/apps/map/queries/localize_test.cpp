#include "apps/map/queries/localize.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>

#include <nlohmann/json.hpp>

#include "apps/map/map_learn.h"
#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/unit/apps/map/walked_rooms.h"

namespace placegraph::apps {
namespace localize_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A map of a walk through three rooms, made once, and six images of the same walls taken between
/// those of the map: two in each room.
class LocalizeCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    test::write_walk(*made, "walk", 3, 20);
    MapLearnArguments learning;
    learning.images = *made / "walk";
    learning.out = *made / "walk.db";
    map_learn(learning);
  }
  static void TearDownTestSuite() { delete made; }
  LocalizeCommand() {
    Random random(9);
    for (int i = 0; i < 6; ++i)
      test::write_image(
          folder, "new/00000" + std::to_string(i) + ".png",
          test::wall_view(i / 2, 4 * frame_of(KeyframeId(i).value()) % 80 + 2, random));
    arguments.map = *made / "walk.db";
    arguments.images = folder / "new";
    arguments.out = folder / "placed.txt";
    arguments.settings = {"min_probability=0.5"};  // sixty views calibrate no better
  }
  /// That image `i` is taken just behind.
  static int frame_of(int i) { return 20 * (i / 2) + 5 + 7 * (i % 2); }
  static test::TemporaryFolder* made;
  test::TemporaryFolder folder;
  LocalizeArguments arguments;
};
test::TemporaryFolder* LocalizeCommand::made = nullptr;

TEST_F(LocalizeCommand, PlacesImagesWhereTheMapLooksLikeThem) {
  const LocalizeResult result = localize(arguments);
  ASSERT_EQ(result.localizations.size(), 6u);
  EXPECT_EQ(result.counts.images, 6u);
  EXPECT_EQ(result.counts.placed, 6u);
  EXPECT_EQ(result.counts.posed, 0u);
  EXPECT_FALSE(result.no_result);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(result.localizations[static_cast<std::size_t>(i)].stage, "appearance");
    EXPECT_NEAR(
        static_cast<double>(result.localizations[static_cast<std::size_t>(i)].frame->value()),
        frame_of(i) + 0.5, 2)
        << i;
  }
  EXPECT_THAT(test::read_file(arguments.out),
              testing::AllOf(testing::StartsWith("# image "), HasSubstr("\n0 0 ")));
}

TEST_F(LocalizeCommand, RefusesAnImageOfARoomThatTheMapDoesNotKnow) {
  Random random(9);
  test::write_image(folder, "new/000003.png", test::wall_view(77, 100, random));
  arguments.as_json = true;
  const LocalizeResult result = localize(arguments);
  EXPECT_EQ(result.counts.placed, 5u);
  EXPECT_EQ(result.counts.refused, (std::map<std::string, std::size_t>{{"appearance", 1}}));
  const json written = json::parse(test::read_file(arguments.out));
  EXPECT_FALSE(written["images"][3]["placed"].get<bool>());
  EXPECT_EQ(written["images"][3]["file"], "000003.png");
  EXPECT_TRUE(written["images"][4]["placed"].get<bool>());
  EXPECT_EQ(json::parse(to_json(result))["refused_by"]["appearance"], 1);
}

TEST_F(LocalizeCommand, RefusesAGreyOrUnreadableImageAndPlacesTheOthers) {
  Random random(9);
  Image grey;
  cv::cvtColor(test::wall_view(0, 22, random), grey, cv::COLOR_BGR2GRAY);
  test::write_image(folder, "new/000000.png", grey);
  folder.write("new/000003.png", "no image");
  testing::internal::CaptureStderr();
  const LocalizeResult result = localize(arguments);
  const std::string warnings = testing::internal::GetCapturedStderr();
  EXPECT_THAT(warnings, HasSubstr("warning: 000000.png: is grey, and the map's images have colour; "
                                  "the image is refused\n"));
  EXPECT_THAT(warnings, HasSubstr("new/000003.png: "));
  EXPECT_EQ(result.counts.placed, 4u);
  EXPECT_FALSE(result.no_result);
  EXPECT_EQ(result.counts.refused,
            (std::map<std::string, std::size_t>{{"grey", 1}, {"unreadable", 1}}));
  const std::string written = test::read_file(arguments.out);
  EXPECT_THAT(written, HasSubstr("\n0 -1 -1 0.000000 refused:grey  # 000000.png\n"));
  EXPECT_THAT(written, HasSubstr("\n3 -1 -1 0.000000 refused:unreadable  # 000003.png\n"));
}

TEST_F(LocalizeCommand, KeepsTheNumbersOfARange) {
  arguments.range = {2, 4};
  const LocalizeResult result = localize(arguments);
  EXPECT_EQ(result.first, 2);
  EXPECT_EQ(result.counts.images, 3u);
  EXPECT_THAT(test::read_file(arguments.out), HasSubstr("tz qx qy qz qw, # file name\n2 "));
  arguments.range = {2, 6};
  arguments.force = true;
  EXPECT_THAT(message_of<ArgumentError>([&] { localize(arguments); }),
              HasSubstr("--range: two numbers of images needed, from 0 to 5"));
}

TEST_F(LocalizeCommand, SaysWhyNothingCanBePlaced) {
  for (int i = 0; i < 6; ++i)
    test::write_image(folder, "new/00000" + std::to_string(i) + ".png",
                      Image(120, 160, CV_8UC3, cv::Scalar(90, 90, 90)));
  EXPECT_EQ(localize(arguments).no_result,
            arguments.images + ": none of the images could be placed");
  StoredMap stored = read_map(arguments.map);
  stored.origin.view_options.clear();
  write_map(folder / "blind.db", stored);
  arguments.map = folder / "blind.db";
  arguments.force = true;
  EXPECT_THAT(message_of<NoResult>([&] { localize(arguments); }),
              HasSubstr("blind.db: holds no views of its keyframes"));
}

TEST(LocalizeText, CountsWhatBecameOfTheImages) {
  LocalizeResult result;
  result.out = "placed.txt";
  result.cpu_ms_an_image = 12.34;
  result.counts = {10, 7, 6, {{"appearance", 2}, {"geometry", 1}}, {{"of another size", 1}}};
  EXPECT_EQ(to_text(result),
            "10 images, 7 placed (6 with a pose; 1 without: of another size), 3 refused (2 by "
            "appearance, 1 by geometry), 12.3 ms CPU an image, written to placed.txt\n");
}

}  // namespace localize_test
}  // namespace placegraph::apps
