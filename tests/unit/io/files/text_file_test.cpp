#include <placegraph/io/files/text_file.h>

#include <cmath>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace text_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

TEST(TextFile, CountsLinesThroughCommentsBlanksAndCarriageReturns) {
  const TemporaryFolder folder;
  TextFile file(folder.write("a.txt", "# head\r\n\r\n1 2\r\n  # note\nlast"));
  std::string_view line;
  ASSERT_TRUE(file.next_data(line));
  EXPECT_EQ(line, "1 2");
  EXPECT_EQ(file.line(), 3);
  ASSERT_TRUE(file.next_data(line));
  EXPECT_EQ(line, "last");
  EXPECT_EQ(file.line(), 5);
  EXPECT_FALSE(file.next_data(line));
  EXPECT_THAT(message_of([&] { file.fail("odd"); }), EndsWith("a.txt:5: odd"));
}

TEST(TextFile, LeavesOutByteOrderMarksAndCommentsBehindData) {
  const TemporaryFolder folder;
  TextFile file(folder.write("a",
                             "\xEF\xBB\xBF"
                             "1 2 # first\na#1.png\n3,# c\n #\n"));
  std::string_view line;
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(file.next_data(line));
    EXPECT_EQ(line, "1 2");
    ASSERT_TRUE(file.next_data(line));
    EXPECT_EQ(line, "a#1.png");
    ASSERT_TRUE(file.next_data(line));
    EXPECT_EQ(line, "3,");
    EXPECT_FALSE(file.next_data(line));
    file.rewind();
  }
  EXPECT_THAT(message_of([&] { TextFile text(folder.write("b", "\xFE\xFF")); }),
              HasSubstr("b: is text in UTF-16"));
}

TEST(TextFile, RefusesWhatIsMissingOrAFolder) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { TextFile(folder / "none.txt"); }), HasSubstr("none.txt: "));
  EXPECT_THAT(message_of([&] { TextFile(folder.path()); }), HasSubstr("is a folder"));
}

TEST(TextFile, SplitsAtBlanksAndAtCommas) {
  std::vector<std::string_view> fields;
  split_blank(" a\t b  c ", fields);
  EXPECT_THAT(fields, ElementsAre("a", "b", "c"));
  split_comma("1, 2,,x ", fields);
  EXPECT_THAT(fields, ElementsAre("1", "2", "", "x"));
}

TEST(ParseDouble, TakesWholeFieldsOnly) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("+1.5e3"), 1500.0);
  EXPECT_EQ(parse_double("-.5"), -0.5);
  EXPECT_EQ(parse_double("1e-400"), 0.0);
  EXPECT_TRUE(std::isnan(parse_double("nan").value()));
  for (const char* wrong : {"", "+", "-", "1.5x", "x", "1,5", "+-1", "0x10", "1e999", "1 2"}) {
    EXPECT_FALSE(parse_double(wrong)) << wrong;
  }
}

TEST(ParseInteger, RefusesFractionsAndOverflow) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  for (const char* wrong : {"", "1.0", "1e3", "9223372036854775808", "12a", "+-3"}) {
    EXPECT_FALSE(parse_integer(wrong)) << wrong;
  }
}

TEST(ParseSeconds, KeepsNanosecondsThatADoubleWouldLose) {
  EXPECT_EQ(parse_seconds_as_ns("1403636579.763555527"), 1403636579763555527);
  EXPECT_EQ(parse_seconds_as_ns("1.037359e-01"), 103735900);
  EXPECT_EQ(parse_seconds_as_ns("1.403636579763555527e+09"), 1403636579763555527);
  EXPECT_EQ(parse_seconds_as_ns("0.0000000005"), 1);
  EXPECT_EQ(parse_seconds_as_ns("0.0000000004"), 0);
  EXPECT_EQ(parse_seconds_as_ns("-2.5"), -2500000000);
  EXPECT_EQ(parse_seconds_as_ns("000.000"), 0);
  EXPECT_EQ(parse_seconds_as_ns("7"), 7000000000);
  EXPECT_EQ(parse_seconds_as_ns("1e-300"), 0);
}

TEST(ParseDecimal, ScalesByPowersOfTenAndSaysWhetherItRounded) {
  bool exact = false;
  EXPECT_EQ(parse_decimal("1600000000000000000.0", 0, &exact), 1600000000000000000);
  EXPECT_TRUE(exact);
  EXPECT_EQ(parse_decimal("1.600000000100000001e+18", 0, &exact), 1600000000100000001);
  EXPECT_TRUE(exact);
  EXPECT_EQ(parse_decimal("2.5", 0, &exact), 3);
  EXPECT_FALSE(exact);
  EXPECT_EQ(parse_decimal("2.5", 6, &exact), 2500000);
  EXPECT_TRUE(exact);
  EXPECT_EQ(parse_decimal("1e-3", 0, &exact), 0);
  EXPECT_FALSE(exact);
}

TEST(ParseSeconds, RefusesWhatIsNoTimeOrDoesNotFit) {
  for (const char* wrong : {"", ".", "-", "nan", "inf", "1e", "1e+", "1.2.3", "1s", "1e400",
                            "1403636579763555527", "9223372036.854775808"}) {
    EXPECT_FALSE(parse_seconds_as_ns(wrong)) << wrong;
  }
}

TEST(ReadTimes, GivesNanosecondsAndRefusesDisorder) {
  const TemporaryFolder folder;
  EXPECT_THAT(read_times(folder.write("t.txt", "0.0\n1.037359e-01\n")), ElementsAre(0, 103735900));
  const auto message = [&](const char* text) {
    const std::string path = folder.write("t.txt", text);
    return message_of([&] { read_times(path); });
  };
  EXPECT_THAT(message("0\n0.2\n0.1\n"), HasSubstr("t.txt:3: time '0.1' does not increase"));
  EXPECT_THAT(message("0\n0\n"), HasSubstr("t.txt:2: "));
  EXPECT_THAT(message("0\nnan\n"), HasSubstr("t.txt:2: time: 'nan'"));
  EXPECT_THAT(message("0\nten\n"), HasSubstr("t.txt:2: "));
  EXPECT_THAT(message("0 1\n"), HasSubstr("t.txt:1: expected one time [s], found 2"));
  EXPECT_THAT(message("\n"), HasSubstr("holds no times"));
  EXPECT_THAT(message_of([&] { read_times(folder / "none"); }), HasSubstr("none: "));
}

TEST(Quotes, HideWhatCannotBePrintedAndCutWhatIsLong) {
  EXPECT_EQ(in_quotes("a\x01z"), "'a?z'");
  EXPECT_EQ(in_quotes(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace text_file_test
}  // namespace placegraph
