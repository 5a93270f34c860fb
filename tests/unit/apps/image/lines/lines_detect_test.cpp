#include "apps/image/lines/lines_detect.h"

#include <placegraph/io/measurements/segment_file.h>

#include <filesystem>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace lines_detect_test {

using test::message_of;
using testing::HasSubstr;

class LinesDetectCommand : public testing::Test {
 protected:
  /// Black, and white from column 50 and above row 80.
  LinesDetectCommand() {
    Image image(120, 100, CV_8UC1, cv::Scalar(30));
    image(cv::Rect(50, 0, 50, 80)) = cv::Scalar(200);
    arguments.image = test::write_image(folder, "a.png", image);
    arguments.out = folder / "segments.txt";
  }
  test::TemporaryFolder folder;
  LinesDetectArguments arguments;
};

TEST_F(LinesDetectCommand, FindsTheEdgesWithTheBrighterSideOnTheRightAndWritesThem) {
  const LinesDetectResult result = lines_detect(arguments);
  ASSERT_EQ(result.segments.size(), 2u);
  const LineSegment& longer = result.segments[0].length() > result.segments[1].length()
                                  ? result.segments[0]
                                  : result.segments[1];
  // Between columns 49 and 50. Whoever goes up has white on the right.
  EXPECT_NEAR(longer.start.x(), 49.5, 0.5);
  EXPECT_NEAR(longer.end.x(), 49.5, 0.5);
  EXPECT_GT(longer.start.y(), longer.end.y());
  EXPECT_NEAR(longer.length(), 80, 5);
  const std::vector<LineSegment> written = read_segments(arguments.out);
  ASSERT_EQ(written.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((written[i].start - result.segments[i].start).norm(), 1e-3);
    EXPECT_LT((written[i].end - result.segments[i].end).norm(), 1e-3);
  }
  EXPECT_EQ(to_text(result), arguments.image + ": 2 segments, written to " + arguments.out + "\n");
}

TEST_F(LinesDetectCommand, LeavesOutWhatIsShorterThanAsked) {
  arguments.options.min_length_px = 60;
  EXPECT_EQ(lines_detect(arguments).segments.size(), 1u);
}

TEST_F(LinesDetectCommand, WritesNothingOfABlankImage) {
  arguments.image =
      test::write_image(folder, "blank.png", Image(100, 100, CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(message_of<NoResult>([&] { lines_detect(arguments); }),
            arguments.image + ": no straight edges");
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(LinesDetectCommand, KeepsAFileThatIsThereAndNamesAnImageThatIsNot) {
  folder.write("segments.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { lines_detect(arguments); }),
              HasSubstr("segments.txt: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
  arguments.force = true;
  arguments.image = folder / "absent.png";
  EXPECT_THAT(message_of([&] { lines_detect(arguments); }), HasSubstr("absent.png: "));
}

}  // namespace lines_detect_test
}  // namespace placegraph::apps
