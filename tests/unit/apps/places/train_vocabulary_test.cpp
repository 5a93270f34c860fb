#include "apps/places/train_vocabulary.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/models/vocabulary_file.h>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/unit/apps/places/twelve_views.h"

namespace placegraph::apps {
namespace train_vocabulary_test {

using test::message_of;
using testing::HasSubstr;

class TrainVocabularyCommand : public testing::Test {
 protected:
  TrainVocabularyCommand() {
    test::write_twelve_views(folder);
    arguments.folders = {folder.path()};
    arguments.out = folder / "words.pgw";
    arguments.words = 20;
  }
  test::TemporaryFolder folder;
  TrainVocabularyArguments arguments;
};

TEST_F(TrainVocabularyCommand, LearnsAboutAsManyWordsAsAskedForAndWritesThem) {
  for (const std::string& kind : vocabulary_kinds()) {
    SCOPED_TRACE(kind);
    arguments.kind = kind;
    arguments.force = true;
    const TrainVocabularyResult result = train_vocabulary(arguments);
    EXPECT_EQ(result.images, 12u);
    EXPECT_GT(result.words, 10);
    EXPECT_LE(result.words, 20);
    const WordTree written = read_vocabulary(arguments.out);
    EXPECT_EQ(written.words, result.words);
    EXPECT_EQ(written.kind == WordTree::Kind::kFloat, kind == "float");
  }
}

TEST_F(TrainVocabularyCommand, AWordThatEveryImageShowsSaysNothing) {
  // log((1 + 12) / (1 + images with the word)) is 0 for such a word, and less than log(13) for all.
  train_vocabulary(arguments);
  const WordTree written = read_vocabulary(arguments.out);
  ASSERT_EQ(written.idf.size(), static_cast<std::size_t>(written.words));
  for (const float idf : written.idf) {
    EXPECT_GE(idf, 0);
    EXPECT_LE(idf, std::log(13.0 / 2) + 1e-6);
  }
}

TEST_F(TrainVocabularyCommand, TakesManyDescriptorsOfSomeImagesRatherThanFewOfAll) {
  arguments.descriptors = 600;  // 150 of every fourth image
  EXPECT_EQ(train_vocabulary(arguments).images, 3u);
}

TEST_F(TrainVocabularyCommand, RefusesWhatItCannotLearnFrom) {
  arguments.kind = "round";
  EXPECT_THAT(message_of<ArgumentError>([&] { train_vocabulary(arguments); }),
              HasSubstr("--kind: 'round' is none of binary, float"));
  arguments.kind = "binary";
  for (int i = 0; i < 12; ++i)
    test::write_image(folder, test::view_name(i), Image(120, 160, CV_8UC1, cv::Scalar(90)));
  EXPECT_THAT(message_of<NoResult>([&] { train_vocabulary(arguments); }),
              HasSubstr("no image has a corner to learn words from"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST(TrainVocabularyText, IsOneLine) {
  EXPECT_EQ(to_text(TrainVocabularyResult{"words.pgw", "float", 97, 12}),
            "97 float words learned from 12 images, written to words.pgw\n");
}

}  // namespace train_vocabulary_test
}  // namespace placegraph::apps
