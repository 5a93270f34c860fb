#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/name_order.h>

#include <algorithm>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace name_order_test {

using Names = std::vector<std::string>;

/// The names after sorting them from the opposite order.
Names sorted(Names names) {
  std::reverse(names.begin(), names.end());
  sort_by_name(names);
  return names;
}

TEST(NameOrder, PutsNumbersByTheirSize) {
  const Names names = {"a/2.png", "a/9.png", "a/10.png", "a/100.png"};
  EXPECT_EQ(sorted(names), names);
  const Names words = {"left.png", "left1.png", "left02.png", "right.png"};
  EXPECT_EQ(sorted(words), words);
}

TEST(NameOrder, ReadsDecimalTimesWithoutTheirLastZeros) {
  const Names decimal = {"1305031102.1.png",  "1305031102.15.png", "1305031102.2.png",
                         "1305031102.25.png", "1305031102.3.png",  "1305031103.05.png"};
  EXPECT_EQ(sorted(decimal), decimal);
  const Names with_words = {"img_8.95s.png", "img_9s.png"};  // no decimal in the second: by text
  EXPECT_EQ(sorted(with_words), with_words);
  const Names seconds = {"img_9.5s.png", "img_9.55s.png", "img_9.6s.png", "img_10.05s.png"};
  EXPECT_EQ(sorted(seconds), seconds);
}

TEST(NameOrder, ReadsSecondsAndNanosecondsWithoutTheirFirstZeros) {
  const Names nanoseconds = {"7.0.png",         "7.50000000.png",  "7.100000000.png",
                             "7.150000000.png", "7.200000000.png", "7.950000000.png",
                             "8.0.png",         "8.50000000.png"};
  EXPECT_EQ(sorted(nanoseconds), nanoseconds);
}

TEST(ImageList, RefusesTwoImagesOfOneName) {
  const test::TemporaryFolder folder;
  folder.write("1.png", "");
  folder.write("2.png", "");
  folder.write("2.jpg", "");
  EXPECT_THAT(test::message_of([&] { list_images(folder / ""); }),
              testing::HasSubstr("2.png: is the same frame as 2.jpg"));
}

}  // namespace name_order_test
}  // namespace placegraph
