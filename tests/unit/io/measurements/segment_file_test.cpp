#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/segment_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace segment_file_test {

TEST(SegmentFile, ReadsWhatItWrote) {
  const test::TemporaryFolder dir;
  write_segments(dir / "s.txt", {{{1.5, 2.25}, {30, -0.125}}, {{0, 0}, {5, 5}}});
  const std::vector<LineSegment> segments = read_segments(dir / "s.txt");
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].start, Eigen::Vector2d(1.5, 2.25));
  EXPECT_EQ(segments[0].end, Eigen::Vector2d(30, -0.125));
  EXPECT_EQ(segments[1].end, Eigen::Vector2d(5, 5));
}

TEST(SegmentFile, TakesTabsAndComments) {
  const test::TemporaryFolder dir;
  EXPECT_EQ(read_segments(dir.write("s.txt", "# u1 v1 u2 v2\n1\t2\t3\t4\t\r\n\n 5 6 7 8\n")).size(),
            2u);
}

TEST(SegmentFile, TakesTheFirstFourColumnsOfATable) {
  const test::TemporaryFolder dir;
  const std::string path = dir.write("s.txt", "1 2 3 4 17\n5 6 7 8 word\n");
  const std::vector<LineSegment> segments = read_segment_columns(path);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[1].end, Eigen::Vector2d(7, 8));
  EXPECT_THROW((void)read_segments(path), FileError);
}

TEST(SegmentFile, NamesTheLineThatIsNoSegment) {
  const test::TemporaryFolder dir;
  const auto message = [&](const std::string& text) {
    const std::string path = dir.write("s.txt", text);
    return test::message_of([&] { (void)read_segments(path); });
  };
  EXPECT_THAT(message("1 2 3 4\n1 2 3\n"), testing::HasSubstr("s.txt:2: a segment has 4 numbers"));
  EXPECT_THAT(message("1 2 three 4\n"), testing::HasSubstr("s.txt:1: u2"));
  EXPECT_THAT(message("1 2 1 2\n"), testing::HasSubstr("s.txt:1: the segment has no length"));
  EXPECT_THAT(message("1 2 3e9 4\n"), testing::HasSubstr("s.txt:1: u2: '3e9' is not a pixel"));
  EXPECT_THROW((void)read_segments(dir / "absent.txt"), FileError);
}

}  // namespace segment_file_test
}  // namespace placegraph
