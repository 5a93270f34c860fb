#include "apps/run/inspect.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace inspect_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

class InspectCommand : public testing::Test {
 protected:
  /// Five images at 10 Hz, the third of them missing, with a calibration.
  void write_sequence() {
    for (int i = 0; i < 4; ++i)
      test::write_image(folder, "s/" + std::to_string(i) + ".png", test::tiny_grey(8, 6, i));
    folder.write("s/calibration.yaml", "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\n");
    folder.write("s/times.txt", "0\n0.1\n0.3\n0.4\n");
    arguments.path = folder / "s";
  }
  test::TemporaryFolder folder;
  InspectArguments arguments;
};

TEST_F(InspectCommand, SaysWhatASequenceIsTakenFor) {
  write_sequence();
  const InspectResult result = inspect(arguments);
  EXPECT_FALSE(result.no_sequence);
  EXPECT_FALSE(result.unreadable);
  EXPECT_EQ(result.summary.frames, 4u);
  EXPECT_EQ(result.summary.spacing.gaps.size(), 1u);
  const std::string text = to_text(result);
  EXPECT_THAT(text, HasSubstr("sequence     s, read as images from " + arguments.path + "\n"));
  EXPECT_THAT(text, HasSubstr("frames       4 in 0.40 s, 10 Hz (0.000 to 0.400 s)\n"));
  EXPECT_THAT(text, HasSubstr("the longest is 0.2 s after frame 1\n"));
  // atan(4.5 / 10) + atan(3.5 / 10) and atan(3.5 / 11) + atan(2.5 / 11)
  EXPECT_THAT(text, HasSubstr("sees 44 x 30 degrees (undistorted)\n"));
  EXPECT_THAT(text, HasSubstr("truth        none\n"));
}

TEST_F(InspectCommand, CountsTheFramesThatCannotBeRead) {
  write_sequence();
  folder.write("s/2.png", "no image");
  arguments.read_all = true;
  const InspectResult result = inspect(arguments);
  ASSERT_TRUE(result.unreadable);
  EXPECT_EQ(result.unreadable->count, 1u);
  EXPECT_THAT(result.unreadable->first, HasSubstr("2.png"));
  EXPECT_THAT(to_text(result), HasSubstr("images       3 of 4 frames can be read\n"));
  EXPECT_EQ(json::parse(to_json(result))["unreadable"], 1);
}

TEST_F(InspectCommand, KnowsImagesThatAreNoSequence) {
  test::write_numbered(folder, "s/images", 3);
  arguments.path = folder / "s";
  const InspectResult result = inspect(arguments);
  ASSERT_TRUE(result.no_sequence);
  EXPECT_EQ(result.images, 3u);
  EXPECT_THAT(to_text(result), HasSubstr("images       3 in " + folder.path() + "/s/images: "));
  EXPECT_THAT(to_text(result), HasSubstr("run          not possible: "));
  EXPECT_EQ(json::parse(to_json(result))["frames"], 3);
}

TEST_F(InspectCommand, RefusesAFolderWithoutImages) {
  folder.write("s/readme.txt", "nothing here");
  arguments.path = folder / "s";
  EXPECT_THROW(inspect(arguments), UnknownLayout);
}

}  // namespace inspect_test
}  // namespace placegraph::apps
