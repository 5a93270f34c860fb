#include "apps/support/label_file.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace label_file_test {

using ::testing::HasSubstr;

TEST(LabelFile, ReadsImageAndLabel) {
  const test::TemporaryFolder folder;
  const auto labels = read_labels(folder.write("labels.txt", "# house\n0 3\n7 0\n"));
  EXPECT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels.at(FrameId(0)), 3);
  EXPECT_EQ(labels.at(FrameId(7)), 0);
}

TEST(LabelFile, NamesTheBrokenLine) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string path = folder.write("labels.txt", text);
    return test::message_of([&] { (void)read_labels(path); });
  };
  EXPECT_THAT(refusal("0 1\n1\n"), HasSubstr("labels.txt:2: 1 columns"));
  EXPECT_THAT(refusal("0 x\n"), HasSubstr("labels.txt:1: label"));
  EXPECT_THAT(refusal("-1 2\n"), HasSubstr("labels.txt:1: image"));
  EXPECT_THAT(refusal("1 99999999999\n"), HasSubstr("labels.txt:1: label"));
  EXPECT_THAT(refusal("1 1\n1 2\n"), HasSubstr("labels.txt:2: image 1 is labelled already"));
  EXPECT_THAT(refusal(""), HasSubstr("labels.txt: no label in it"));
}

}  // namespace label_file_test
}  // namespace placegraph::apps
