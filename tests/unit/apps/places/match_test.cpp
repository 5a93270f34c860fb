#include "apps/places/match.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/loops/loop_file.h>

#include "apps/places/train_vocabulary.h"
#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/unit/apps/places/twelve_views.h"

namespace placegraph::apps {
namespace match_test {

namespace fs = std::filesystem;
using test::message_of;
using testing::HasSubstr;

class MatchCommand : public testing::Test {
 protected:
  MatchCommand() {
    test::write_twelve_views(folder);
    arguments.folder = folder.path();
    arguments.out = folder / "found.txt";
  }
  /// The scores of the answers.
  std::vector<double> scores() {
    arguments.force = true;
    std::vector<double> scores;
    for (const LoopPrediction& found : match(arguments).found) scores.push_back(found.score);
    return scores;
  }
  test::TemporaryFolder folder;
  MatchArguments arguments;
};

TEST_F(MatchCommand, FindsTheOlderViewOfEveryPlaceAndWritesIt) {
  const MatchResult result = match(arguments);
  EXPECT_EQ(result.images, 12u);
  EXPECT_EQ(result.queries, 6u);
  ASSERT_EQ(result.found.size(), 6u);
  const auto written = read_loop_predictions(arguments.out, LoopFileFormat::kScores);
  ASSERT_EQ(written.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(result.found[i].query, FrameId(static_cast<std::int64_t>(i) + 6));
    EXPECT_EQ(result.found[i].candidate, FrameId(i));
    EXPECT_EQ(written[i].candidate, result.found[i].candidate);
    EXPECT_NEAR(written[i].score, result.found[i].score, 1e-4);
  }
}

TEST_F(MatchCommand, AsksEveryImageThatIsOldEnoughWhateverTheTruthSays) {
  arguments.min_age = 8;
  const MatchResult result = match(arguments);
  EXPECT_EQ(result.queries, 4u);
  for (const LoopPrediction& found : result.found) {
    EXPECT_GE(found.query, FrameId(8));
    EXPECT_LE(found.candidate.value(), found.query.value() - 8);
  }
  arguments.min_age.reset();
  fs::remove(folder / "gt.txt");
  arguments.force = true;
  EXPECT_THAT(message_of<ArgumentError>([&] { match(arguments); }),
              HasSubstr("12 images, and none is 300 older than another (see --min-age)"));
}

TEST_F(MatchCommand, ACueThatIsLeftOutHasNoWeight) {
  const std::vector<double> all = scores();
  for (const std::string& left_out : place_cue_names()) {
    SCOPED_TRACE(left_out);
    arguments.cues = place_cue_names();
    std::erase(arguments.cues, left_out);
    arguments.settings.clear();
    const std::vector<double> without = scores();
    EXPECT_NE(without, all);
    arguments.cues.clear();
    arguments.settings = {"recognizer.cues." + left_out + "=0"};
    EXPECT_EQ(scores(), without);
  }
}

TEST_F(MatchCommand, TheImagesBeforeTellAnImageThatCouldBeTwoPlaces) {
  // Image 9 is place 3, under more of place 0.
  Image blend;
  cv::addWeighted(test::place_picture(0), 0.52, test::place_picture(3), 0.48, 0, blend);
  test::write_image(folder, test::view_name(9), blend);
  EXPECT_EQ(match(arguments).found[3].candidate, FrameId(0));
  arguments.sequence = arguments.force = true;
  const MatchResult result = match(arguments);
  ASSERT_EQ(result.found.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(result.found[i].candidate, FrameId(i));
}

TEST_F(MatchCommand, ComparesWordsOfAVocabulary) {
  TrainVocabularyArguments training;
  training.folders = {folder.path()};
  training.out = arguments.vocabulary = folder / "words.pgw";
  training.kind = "float";
  training.words = 30;
  train_vocabulary(training);
  arguments.codes = "llc";
  const MatchResult result = match(arguments);
  ASSERT_EQ(result.found.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(result.found[i].candidate, FrameId(i));

  arguments.force = true;
  arguments.codes = "bow";
  EXPECT_THAT(message_of<ArgumentError>([&] { match(arguments); }),
              HasSubstr("words.pgw: --codes bow needs a vocabulary of --kind binary"));
  arguments.vocabulary.clear();
  arguments.codes = "llc";
  EXPECT_THAT(message_of<ArgumentError>([&] { match(arguments); }),
              HasSubstr("--codes llc needs a --vocabulary of --kind float"));
}

TEST_F(MatchCommand, AnImageWithoutWordsHasNoAnswer) {
  for (int i = 0; i < 12; ++i)
    test::write_image(folder, test::view_name(i), Image(120, 160, CV_8UC3, cv::Scalar(90, 90, 90)));
  arguments.codes = "bow";
  EXPECT_THAT(message_of<NoResult>([&] { match(arguments); }),
              HasSubstr(": no image has a word in common with an older one"));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST_F(MatchCommand, NamesTheFileAndThePlaceOfWhatIsWrong) {
  arguments.cues = {"smell"};
  EXPECT_THAT(message_of<ArgumentError>([&] { match(arguments); }),
              HasSubstr("--appearance: 'smell' is none of tiny, "));
  arguments.cues.clear();
  folder.write("gt.txt", "6 0 50 0\n");
  EXPECT_THAT(message_of([&] { match(arguments); }),
              HasSubstr("gt.txt: image 50, and there are 12"));
  folder.write("gt.txt", "6 0\n7 1\n");
  EXPECT_THAT(message_of([&] { match(arguments); }),
              HasSubstr("gt.txt: lists no candidates (query first last ...): use --min-age"));
  folder.write("gt.txt", "6 0 5 0\n");
  test::write_image(folder, test::view_name(3), Image(120, 160, CV_8UC1, cv::Scalar(90)));
  EXPECT_THAT(message_of([&] { match(arguments); }),
              HasSubstr("000013.png: is grey, and the images before it have colour"));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST(MatchText, SaysHowManyHaveAnAnswer) {
  MatchResult result{"found.txt", 20, 4, {}, 12.34};
  result.found.resize(3);
  EXPECT_EQ(to_text(result), "20 images, 3 queries, 12.3 ms CPU an image, written to found.txt\n");
}

}  // namespace match_test
}  // namespace placegraph::apps
