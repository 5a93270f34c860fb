#include <gtest/gtest.h>
#include <placegraph/graph/text/wrapped_text.h>

namespace placegraph {
namespace wrapped_text_test {

TEST(WrappedText, LinesAreAtMostAsLongAsTheWidth) {
  EXPECT_EQ(wrapped_text("one two three four", "", 9), "one two\nthree\nfour\n");
  EXPECT_EQ(wrapped_text("one two", "", 7), "one two\n");
  EXPECT_EQ(wrapped_text("one two", "", 6), "one\ntwo\n");
}

TEST(WrappedText, LinesAfterTheFirstAreIndented) {
  EXPECT_EQ(wrapped_text("- one two", "  ", 6), "- one\n  two\n");
}

TEST(WrappedText, ALongWordHasALineOfItsOwn) {
  EXPECT_EQ(wrapped_text("a abcdefgh b", "", 4), "a\nabcdefgh\nb\n");
  EXPECT_EQ(wrapped_text("abcdefgh", "  ", 4), "abcdefgh\n");
}

TEST(WrappedText, SpacesAndLineBreaksOfTheTextSeparateWords) {
  EXPECT_EQ(wrapped_text("  one \n two  ", ""), "one two\n");
  EXPECT_EQ(wrapped_text("", ""), "\n");
}

}  // namespace wrapped_text_test
}  // namespace placegraph
