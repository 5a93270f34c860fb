#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"
#include "tests/support/pictures.h"

namespace placegraph {
namespace match_cli_test {

using test::write_file;
using ::testing::HasSubstr;

/// Six places in colour, each seen twice: images 0 to 5, and the same from beside as 6 to 11.
class Match : public test::CliTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(dir / "images");
    std::string truth;
    for (int i = 0; i < 12; ++i) {
      cv::Mat coarse(9, 12, CV_8UC3), image;
      cv::RNG random(static_cast<std::uint64_t>(i % 6) + 1);
      random.fill(coarse, cv::RNG::UNIFORM, 20, 200);
      cv::resize(coarse, image, {160, 120}, 0, 0, cv::INTER_CUBIC);
      if (i >= 6) image = image(cv::Rect(12, 0, 148, 120)).clone();
      test::write_picture(dir / ("images/0000" + std::to_string(i + 10) + ".png"), image);
      if (i >= 6) truth += std::to_string(i) + " 0 5 " + std::to_string(i - 6) + "\n";
    }
    write_file(dir / "gt.txt", truth);
  }
};

TEST_F(Match, WritesOneBestCandidateAQueryThatTheBenchmarkReads) {
  for (const std::string mode : {"", "--sequence "}) {
    const auto matched = run("match . --out found.txt --force " + mode);
    ASSERT_EQ(matched.code, 0) << matched.err;
    EXPECT_THAT(matched.out, HasSubstr("12 images, 6 queries"));
    const auto judged = run("loops --predictions found.txt --truth gt.txt --json");
    ASSERT_EQ(judged.code, 0) << judged.err;
    const auto json = nlohmann::json::parse(judged.out);
    EXPECT_EQ(json.at("answered"), 6);
    EXPECT_EQ(json.at("r_at_1"), 1);
  }
  expect_usage_error("match . --out found.txt", "found.txt");
}

TEST_F(Match, ComparesWithWhatIsOldEnoughWithoutATruth) {
  std::filesystem::remove(dir / "gt.txt");
  expect_usage_error("match . --out found.txt", "12 images, and none is 300 older");
  const auto matched = run("match images --min-age 6 --out found.txt --appearance tiny,gradients");
  ASSERT_EQ(matched.code, 0) << matched.err;
  EXPECT_THAT(test::read_file(dir / "found.txt"), ::testing::StartsWith("6 0 "));
}

TEST_F(Match, RefusesBrokenInput) {
  expect_usage_error("match none --out found.txt", "none");
  expect_usage_error("match . --out found.txt --appearance smell", "smell");
  expect_usage_error("match . --out found.txt --set recognizer.short_lst=3", "unknown key");
  write_file(dir / "gt.txt", "6 0 50 0\n");
  expect_usage_error("match . --out found.txt", "gt.txt: image 50, and there are 12");
  write_file(dir / "gt.txt", "6 0\n7 1\n");
  expect_usage_error("match . --out found.txt", "gt.txt: lists no candidates");
  write_file(dir / "gt.txt", "6 0 5 0\n");
  write_file(dir / "images/000016.png", "no image");
  expect_usage_error("match . --out found.txt", "000016.png");
}

TEST_F(Match, SaysThatGreyImagesHaveNoColour) {
  std::filesystem::remove(dir / "images/000010.png");
  test::write_picture(dir / "images/000010.png", cv::Mat(120, 160, CV_8UC1, cv::Scalar(90)));
  const auto matched = run("match . --out found.txt");
  ASSERT_EQ(matched.code, 0) << matched.err;
  EXPECT_THAT(matched.err, HasSubstr("the colour cue is not used"));
}

TEST_F(Match, LearnsLabelsOfTheTrainingHalfOnly) {
  std::string labels;
  for (int i = 0; i < 6; ++i) labels += std::to_string(i) + " " + std::to_string(i / 3) + "\n";
  write_file(dir / "labels.txt", labels);  // none of the images that are asked for
  for (const std::string mode : {"", "--sequence "}) {
    const auto classified = run("places classify . --out told.txt --force " + mode);
    ASSERT_EQ(classified.code, 0) << classified.err;
    EXPECT_THAT(classified.out, HasSubstr("6 training views, 6 predictions"));
    EXPECT_THAT(test::read_file(dir / "told.txt"), ::testing::StartsWith("6 0 "));
    EXPECT_THAT(test::read_file(dir / "told.txt"), HasSubstr("\n11 1 "));
  }
  ASSERT_EQ(run("places classify . --out told.txt --force --reject 1").code, 0);
  EXPECT_THAT(test::read_file(dir / "told.txt"), HasSubstr("6 -1 "));
  write_file(dir / "labels.txt", "0 0\n1\n");
  expect_usage_error("places classify . --out no.txt", "labels.txt:2");
  write_file(dir / "labels.txt", "0 0\n");
  expect_usage_error("places classify . --out no.txt", "labels.txt: no label for training image 1");
  expect_usage_error("places classify . --out no.txt --train 12", "there are 12 images");
}

TEST_F(Match, TellsPlacesByWordsOfAVocabulary) {
  const auto trained = run("train vocabulary images --kind float --words 30 --out words.pgw");
  ASSERT_EQ(trained.code, 0) << trained.err;
  EXPECT_THAT(trained.out, HasSubstr("float words learned from 12 images"));
  EXPECT_THAT(run("places vocabulary words.pgw").out, HasSubstr("float words, "));
  const auto matched = run("match . --out found.txt --vocabulary words.pgw --codes llc");
  ASSERT_EQ(matched.code, 0) << matched.err;
  EXPECT_THAT(matched.out, HasSubstr("12 images, 6 queries"));
  const auto judged = run("loops --predictions found.txt --truth gt.txt --json");
  EXPECT_GE(nlohmann::json::parse(judged.out).at("r_at_1").get<double>(), 0.8);
  // So smooth are the images that no key-point is found in them: no word, and no answer.
  const auto none = run("match . --out none.txt --vocabulary words.pgw --codes bow_float");
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("no image has a word in common with an older one"));
}

TEST_F(Match, RefusesVocabulariesThatDoNotServe) {
  ASSERT_EQ(run("train vocabulary images --kind binary --words 20 --out words.pgw").code, 0);
  expect_usage_error("train vocabulary images --out words.pgw", "words.pgw");
  expect_usage_error("match . --out no.txt --codes llc", "needs a --vocabulary of --kind float");
  expect_usage_error("match . --out no.txt --codes llc --vocabulary words.pgw", "--kind float");
  const std::string bytes = test::read_file(dir / "words.pgw");
  write_file(dir / "cut.pgw", bytes.substr(0, bytes.size() - 1));
  expect_usage_error("match . --out no.txt --codes bow --vocabulary cut.pgw",
                     "cut.pgw: byte " + std::to_string(bytes.size() - 1) + ": truncated");
  expect_usage_error("places vocabulary gt.txt", "gt.txt: byte 0: not a vocabulary");
}

TEST_F(Match, TellsLabelsByEveryClassifierAndRefusesTheUnsure) {
  std::string labels;
  for (int i = 0; i < 6; ++i) labels += std::to_string(i) + " " + std::to_string(i / 3) + "\n";
  write_file(dir / "labels.txt", labels);
  for (const std::string classifier : {"svm", "adaboost"}) {
    const auto classified =
        run("places classify . --out told.txt --force --appearance colours,tiny --classifier " +
            classifier);
    ASSERT_EQ(classified.code, 0) << classified.err;
    EXPECT_THAT(classified.out, HasSubstr("6 training views, 6 predictions"));
  }
  ASSERT_EQ(run("places classify . --out told.txt --force --max-entropy 0").code, 0);
  EXPECT_THAT(test::read_file(dir / "told.txt"), HasSubstr("6 -1 "));
  expect_usage_error("places classify . --out no.txt --classifier oracle", "oracle");
}

TEST_F(Match, KeepsItsTargetsOnARealCorridor) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "places/corridor_milford");
  const auto matched = run("match " + folder + " --sequence --out found.txt");
  ASSERT_EQ(matched.code, 0) << matched.err;
  const auto judged = run("loops --predictions found.txt --truth " + folder + "/gt.txt --json");
  const auto json = nlohmann::json::parse(judged.out);
  EXPECT_GE(json.at("r_at_1").get<double>(), 0.99);
  EXPECT_GE(json.at("ap").get<double>(), 0.98);
  EXPECT_GE(json.at("recall_at_100p").get<double>(), 0.6);
}

}  // namespace match_cli_test
}  // namespace placegraph
