#include "apps/image/lines/lines_match.h"

#include <placegraph/io/measurements/segment_file.h>

#include <algorithm>
#include <filesystem>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/tiles.h"
#include "tests/support/seed.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace lines_match_test {

using test::message_of;
using testing::HasSubstr;

/// A wall of twenty tiles in two views, one turned against the other, with the segments of both.
class LinesMatchCommand : public testing::Test {
 protected:
  LinesMatchCommand() {
    Random random = test::seeded_random(11);
    const test::TiledWall wall(5, 4, 60, random);
    Eigen::Matrix3d H;
    H << 0.85, -0.3, 70, 0.3, 0.85, -10, 0, 0, 1;
    arguments.images = {
        test::write_image(folder, "a.png", wall.seen(300, 240, Eigen::Matrix3d::Identity())),
        test::write_image(folder, "b.png", wall.seen(320, 260, H))};
    a = wall.edges(Eigen::Matrix3d::Identity());
    b = wall.edges(H);
    std::reverse(b.begin(), b.end());
    arguments.out = folder / "m.txt";
  }
  void give_segments() {
    write_segments(folder / "a.txt", a);
    write_segments(folder / "b.txt", b);
    arguments.segments = {folder / "a.txt", folder / "b.txt"};
  }
  std::vector<LineSegment> a, b;  ///< segment i of one is segment 79 - i of the other
  test::TemporaryFolder folder;
  LinesMatchArguments arguments;
};

TEST_F(LinesMatchCommand, TellsWhichGivenSegmentsAreTheSame) {
  give_segments();
  const LinesMatchResult result = lines_match(arguments);
  EXPECT_EQ(result.a.size(), 80u);
  EXPECT_GT(result.matches.size(), 50u);
  std::string lines;
  for (const SegmentMatch& match : result.matches) {
    EXPECT_EQ(match.a + match.b, 79);
    lines += std::to_string(match.a) + " " + std::to_string(match.b) + "\n";
  }
  EXPECT_EQ(test::read_file(arguments.out), lines);
  EXPECT_EQ(to_text(result), arguments.images[0] + ", " + arguments.images[1] +
                                 ": 80 and 80 segments, " + std::to_string(result.matches.size()) +
                                 " matches, written to " + arguments.out + "\n");
}

TEST_F(LinesMatchCommand, WritesTheSegmentsThatItDetectsInTheOrderOfTheImages) {
  arguments.segments_out = {folder / "sa.txt", folder / "sb.txt"};
  const LinesMatchResult result = lines_match(arguments);
  EXPECT_GT(result.matches.size(), 40u);
  ASSERT_EQ(read_segments(folder / "sa.txt").size(), result.a.size());
  ASSERT_EQ(read_segments(folder / "sb.txt").size(), result.b.size());
  EXPECT_LT((read_segments(folder / "sa.txt")[0].start - result.a[0].start).norm(), 1e-3);
  EXPECT_LT((read_segments(folder / "sb.txt")[0].start - result.b[0].start).norm(), 1e-3);
}

TEST_F(LinesMatchCommand, WritesNothingWhereNothingJoinsTheImages) {
  give_segments();
  arguments.images[1] =
      test::write_image(folder, "blank.png", Image(260, 320, CV_8UC1, cv::Scalar(90)));
  EXPECT_THAT(message_of<NoResult>([&] { lines_match(arguments); }),
              HasSubstr(arguments.images[0] + ", " + arguments.images[1] + ": "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(LinesMatchCommand, NamesTheLineOfABrokenFileAndCountsWhatItNeedsTwoOf) {
  give_segments();
  folder.write("b.txt", "1 2 3 4\n1 2 3\n");
  EXPECT_THAT(message_of([&] { lines_match(arguments); }), HasSubstr("b.txt:2: "));
  arguments.segments.pop_back();
  EXPECT_EQ(message_of<ArgumentError>([&] { lines_match(arguments); }),
            "--segments: two files are needed");
  arguments.images.pop_back();
  EXPECT_EQ(message_of<ArgumentError>([&] { lines_match(arguments); }), "IMAGES: two are needed");
}

}  // namespace lines_match_test
}  // namespace placegraph::apps
