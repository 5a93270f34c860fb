#include "apps/places/vocabulary_info.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/models/vocabulary_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace vocabulary_info_test {

using test::message_of;
using testing::HasSubstr;

/// A root with three words below it.
WordTree three_words(WordTree::Kind kind) {
  WordTree tree;
  tree.kind = kind;
  tree.words = 3;
  tree.idf = {0.5f, 1, 2};
  tree.nodes = {{1, 3, -1}, {-1, 0, 0}, {-1, 0, 1}, {-1, 0, 2}};
  if (kind == WordTree::Kind::kBinary) {
    tree.bit_centres.resize(4);
    for (std::uint64_t i = 0; i < 4; ++i) tree.bit_centres[i][0] = i;
  } else {
    tree.dimension = 128;
    tree.centres.resize(4 * 128, 0.1f);
  }
  return tree;
}

TEST(VocabularyInfoCommand, CountsTheWordsAndNodesOfBothKinds) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "words.pgw";
  for (const auto kind : {WordTree::Kind::kBinary, WordTree::Kind::kFloat}) {
    write_vocabulary(path, three_words(kind));
    const VocabularyInfoResult info = vocabulary_info({path});
    EXPECT_EQ(info.vocabulary, path);
    EXPECT_EQ(info.kind, kind == WordTree::Kind::kFloat ? "float" : "binary");
    EXPECT_EQ(info.words, 3);
    EXPECT_EQ(info.nodes, 4u);
  }
}

TEST(VocabularyInfoCommand, RefusesAFileThatIsNoVocabulary) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { vocabulary_info({folder.write("gt.txt", "6 0 5 0\n")}); }),
              HasSubstr("gt.txt: byte 0: not a vocabulary"));
  EXPECT_THAT(message_of([&] { vocabulary_info({folder / "none.pgw"}); }), HasSubstr("none.pgw"));
}

TEST(VocabularyInfoText, IsOneLine) {
  EXPECT_EQ(to_text(VocabularyInfoResult{"words.pgw", "binary", 97, 102, 3.6}),
            "words.pgw: 97 binary words, 102 nodes, read in 4 ms\n");
}

}  // namespace vocabulary_info_test
}  // namespace placegraph::apps
