#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/models/vocabulary_file.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace vocabulary_file_test {

using ::testing::HasSubstr;

/// A root with two words.
WordTree small_tree(WordTree::Kind kind) {
  WordTree tree;
  tree.kind = kind;
  tree.words = 2;
  tree.nodes = {{1, 2, -1}, {-1, 0, 0}, {-1, 0, 1}};
  if (kind == WordTree::Kind::kBinary) {
    tree.bit_centres = {{}, {1, 2, 3, 4}, {5, 6, 7, 8}};
  } else {
    tree.dimension = 2;
    tree.centres = {0, 0, 0.5f, 1, -1, 2};
  }
  tree.idf = {0.25f, 3};
  return tree;
}

class VocabularyFile : public ::testing::Test {
 protected:
  std::string written(const WordTree& tree) {
    write_vocabulary(path, tree);
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::string refusal(const std::string& bytes) {
    const std::string broken = folder.write("broken.pgw", bytes);
    return test::message_of([&] { (void)read_vocabulary(broken); });
  }
  test::TemporaryFolder folder;
  std::string path = folder / "words.pgw";
};

TEST_F(VocabularyFile, ReadsWhatWasWritten) {
  for (const WordTree::Kind kind : {WordTree::Kind::kBinary, WordTree::Kind::kFloat}) {
    const WordTree tree = small_tree(kind);
    write_vocabulary(path, tree);
    const WordTree read = read_vocabulary(path);
    EXPECT_EQ(read.kind, tree.kind);
    EXPECT_EQ(read.words, 2);
    EXPECT_EQ(read.nodes[0].children, 2);
    EXPECT_EQ(read.nodes[2].word, 1);
    EXPECT_EQ(read.bit_centres, tree.bit_centres);
    EXPECT_EQ(read.centres, tree.centres);
    EXPECT_EQ(read.idf, tree.idf);
  }
}

TEST_F(VocabularyFile, SaysAtWhichByteItIsBroken) {
  const std::string good = written(small_tree(WordTree::Kind::kFloat));
  EXPECT_EQ(good.size(), 28u + 3 * 12 + 6 * 4 + 2 * 4);
  EXPECT_THAT(refusal(""), HasSubstr("broken.pgw: byte 0: not a vocabulary"));
  EXPECT_THAT(refusal("PGWORLDS" + good), HasSubstr("byte 0: not a vocabulary"));
  EXPECT_THAT(refusal(good.substr(0, 20)), HasSubstr("byte 20: ends within the header"));
  EXPECT_THAT(refusal(good.substr(0, 50)), HasSubstr("byte 50: truncated"));
  EXPECT_THAT(refusal(good + "x"), HasSubstr("byte 97: goes on too long"));
  const auto with = [&](std::size_t byte, char value) {
    std::string bytes = good;
    bytes[byte] = value;
    return refusal(bytes);
  };
  EXPECT_THAT(with(8, 9), HasSubstr("byte 8: version 9"));
  EXPECT_THAT(with(12, 7), HasSubstr("byte 12: kind 7"));
  EXPECT_THAT(with(16, 0), HasSubstr("byte 16: 0 numbers a word"));
  EXPECT_THAT(with(20, 0), HasSubstr("byte 20: 0 words"));
  EXPECT_THAT(with(23, 127), HasSubstr("byte 20: "));  // a count that fits no memory
  EXPECT_THAT(with(28, 0), HasSubstr("node 0 has children outside the tree"));
  EXPECT_THROW((void)read_vocabulary(folder / "none"), FileError);
  EXPECT_THAT(refusal(good + "x"), HasSubstr("byte 97"));
  std::filesystem::resize_file(folder / "broken.pgw", std::uintmax_t{3} << 30);  // holes alone
  EXPECT_THAT(test::message_of([&] { (void)read_vocabulary(folder / "broken.pgw"); }),
              HasSubstr("a vocabulary is not larger than 2 GiB"));
}

TEST_F(VocabularyFile, WritesNoTreeThatIsNone) {
  WordTree tree = small_tree(WordTree::Kind::kFloat);
  tree.centres[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_vocabulary(path, tree), ArgumentError);
}

}  // namespace vocabulary_file_test
}  // namespace placegraph
