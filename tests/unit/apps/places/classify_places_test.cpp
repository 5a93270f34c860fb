#include "apps/places/classify_places.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <set>

#include "tests/support/message_of.h"
#include "tests/unit/apps/places/twelve_views.h"

namespace placegraph::apps {
namespace classify_places_test {

using test::message_of;
using testing::HasSubstr;

/// The twelve views, two places of three views each; those of the second half have no label.
class ClassifyPlacesCommand : public testing::Test {
 protected:
  ClassifyPlacesCommand() {
    test::write_twelve_views(folder);
    write_labels(6);
    arguments.folder = folder.path();
    arguments.out = folder / "predictions.txt";
  }
  void write_labels(int images) {
    std::string labels;
    for (int i = 0; i < images; ++i)
      labels += std::to_string(i) + " " + std::to_string(i % 6 / 3) + "\n";
    folder.write("labels.txt", labels);
  }
  test::TemporaryFolder folder;
  ClassifyPlacesArguments arguments;
};

TEST_F(ClassifyPlacesCommand, TellsTheImagesThatAreAskedForByThoseThatWereLearned) {
  for (const std::string machine : {"kernel", "svm"}) {
    SCOPED_TRACE(machine);
    arguments.classifier = machine;
    arguments.force = true;
    const ClassifyPlacesResult result = classify_places(arguments);
    EXPECT_EQ(result.learned, 6u);
    EXPECT_EQ(result.refused, 0u);
    EXPECT_EQ(result.weights.size(), place_cues().size());
    ASSERT_EQ(result.predictions.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(result.predictions[i].image, FrameId(static_cast<std::int64_t>(i) + 6));
      EXPECT_EQ(result.predictions[i].label, static_cast<int>(i / 3));
      EXPECT_GT(result.predictions[i].probability, 0.5);
      EXPECT_LE(result.predictions[i].probability, 1);
    }
    EXPECT_THAT(test::read_file(arguments.out), testing::StartsWith("6 0 0."));
    EXPECT_THAT(test::read_file(arguments.out), HasSubstr("\n11 1 0."));
  }
}

TEST_F(ClassifyPlacesCommand, EveryMachineIsAnother) {
  arguments.force = true;
  std::set<double> probabilities;
  for (const std::string& machine : place_machines()) {
    arguments.classifier = machine;
    probabilities.insert(classify_places(arguments).predictions.front().probability);
  }
  EXPECT_EQ(probabilities.size(), 3u);
}

TEST_F(ClassifyPlacesCommand, LearnsTheFirstImagesWhateverTheTruthSays) {
  write_labels(8);
  arguments.train = 8;
  const ClassifyPlacesResult result = classify_places(arguments);
  EXPECT_EQ(result.learned, 8u);
  ASSERT_EQ(result.predictions.size(), 4u);
  EXPECT_EQ(result.predictions.front().image, FrameId(8));
  arguments.train = 12;
  arguments.force = true;
  EXPECT_THAT(message_of<ArgumentError>([&] { classify_places(arguments); }),
              HasSubstr("--train 12: there are 12 images"));
}

TEST_F(ClassifyPlacesCommand, RefusesToTellWhatItIsNotSureOf) {
  arguments.reject = 1;
  EXPECT_EQ(classify_places(arguments).refused, 6u);
  EXPECT_THAT(test::read_file(arguments.out), testing::StartsWith("6 -1 0."));
  arguments.reject = 0;
  arguments.max_entropy = 0;
  arguments.force = true;
  const ClassifyPlacesResult result = classify_places(arguments);
  EXPECT_EQ(result.refused, 6u);
  for (const ClassifiedPlace& classified_place : result.predictions)
    EXPECT_EQ(classified_place.label, -1);
}

TEST_F(ClassifyPlacesCommand, ACueThatDoesNotCountHasNoWeight) {
  arguments.cues = {"tiny", "edges"};
  const ClassifyPlacesResult result = classify_places(arguments);
  ASSERT_EQ(result.weights.size(), place_cues().size());
  double named = 0;  // one of both may tell the places alone
  for (std::size_t m = 0; m < place_cues().size(); ++m) {
    if (place_cues()[m] == "tiny" || place_cues()[m] == "edges")
      named += result.weights[m];
    else
      EXPECT_EQ(result.weights[m], 0) << place_cues()[m];
  }
  EXPECT_GT(named, 0);
}

TEST_F(ClassifyPlacesCommand, NamesTheFileAndThePlaceOfWhatIsWrong) {
  folder.write("labels.txt", "0 0\n1\n");
  EXPECT_THAT(message_of([&] { classify_places(arguments); }), HasSubstr("labels.txt:2"));
  folder.write("labels.txt", "0 0\n1 1\n");
  EXPECT_THAT(message_of([&] { classify_places(arguments); }),
              HasSubstr("labels.txt: no label for training image 2"));
  write_labels(6);
  folder.write("gt.txt", "6 0 6 0\n");
  EXPECT_THAT(message_of<ArgumentError>([&] { classify_places(arguments); }),
              HasSubstr("gt.txt: image 6 is a query and a candidate"));
  arguments.classifier = "oracle";
  EXPECT_THAT(message_of<ArgumentError>([&] { classify_places(arguments); }),
              HasSubstr("--classifier: 'oracle' is none of kernel, "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST(ClassifyPlacesText, SaysWhatWasLearnedAndHowWell) {
  ClassifyPlacesResult result;
  result.out = "predictions.txt";
  result.learned = 20;
  result.predictions.resize(5);
  result.refused = 2;
  result.weights = {0.5, 1, 0, 0.25, 1};
  result.accuracy = 0.9, result.log_loss = 0.123;
  EXPECT_EQ(to_text(result),
            "20 training views, 5 predictions, 2 rejected; weights of colours 0.5, quarters 1, "
            "edges 0, tiny "
            "0.25, gabor 1; cross-validated accuracy 0.900, log loss 0.123; written to "
            "predictions.txt\n");
}

}  // namespace classify_places_test
}  // namespace placegraph::apps
