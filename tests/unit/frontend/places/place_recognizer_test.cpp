#include <gtest/gtest.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace place_recognizer_test {

/// A picture of its own for every place, seen shifted by `shift_px` and brighter by `gain`.
Image picture(int place, int shift_px = 0, double gain = 1, int channels = 3) {
  Random random(77, static_cast<std::uint64_t>(place));
  cv::Mat coarse(9, 12, channels == 3 ? CV_8UC3 : CV_8UC1), image;
  for (int y = 0; y < coarse.rows; ++y)
    for (int i = 0; i < coarse.cols * channels; ++i)
      coarse.ptr<uchar>(y)[i] = static_cast<uchar>(random.uniform(20, 180));
  cv::resize(coarse, image, {160, 120}, 0, 0, cv::INTER_CUBIC);
  const cv::Mat motion = (cv::Mat_<double>(2, 3) << 1, 0, shift_px, 0, 1, 0);
  cv::warpAffine(image, image, motion, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  image.convertTo(image, -1, gain);
  return image;
}

PlaceRecognizer with_places(const PlaceRecognizerOptions& options, int places, int channels = 3) {
  PlaceRecognizer recognizer(options);
  for (int place = 0; place < places; ++place)
    recognizer.add(describe_place(picture(place, 0, 1, channels), options.cues, false));
  return recognizer;
}

TEST(PlaceRecognizer, FindsThePlaceSeenFromBesideAndInOtherLight) {
  const PlaceRecognizerOptions options;
  const PlaceRecognizer recognizer = with_places(options, 6);
  const PlaceView query = describe_place(picture(4, 20, 0.8), options.cues, true);
  const auto list = recognizer.query(query, 0, 5);
  ASSERT_EQ(list.size(), 6u);
  EXPECT_EQ(list.front().view, 4);
  EXPECT_GT(list.front().score, list[1].score + 0.3);
}

TEST(PlaceRecognizer, SearchesOnlyTheGivenViews) {
  const PlaceRecognizerOptions options;
  const PlaceRecognizer recognizer = with_places(options, 6);
  const PlaceView query = describe_place(picture(4), options.cues, true);
  const auto list = recognizer.query(query, 0, 3);
  EXPECT_EQ(list.size(), 4u);
  EXPECT_TRUE(std::none_of(list.begin(), list.end(), [](const auto& l) { return l.view == 4; }));
  EXPECT_TRUE(recognizer.query(query, 4, 3).empty());
  EXPECT_EQ(recognizer.query(query, 5, 99).size(), 1u);
}

TEST(PlaceRecognizer, FindsThePlaceOnAShortListToo) {
  PlaceRecognizerOptions options;
  options.short_list = 3;
  options.verified = 1;
  const PlaceRecognizer recognizer = with_places(options, 8);
  const auto list = recognizer.query(describe_place(picture(6, 15), options.cues, true), 0, 7);
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list.front().view, 6);
}

TEST(PlaceRecognizer, FindsAlongTheGraphWhatTheFirstLookFindsAmongAll) {
  PlaceRecognizerOptions options;
  options.cues.corners = 0;
  PlaceRecognizerOptions indexed = options;
  indexed.indexed_from = 4;
  const PlaceRecognizer all = with_places(options, 6), graph = with_places(indexed, 6);
  for (int place = 0; place < 6; ++place) {
    const PlaceView query = describe_place(picture(place, 8), options.cues, true);
    const auto expected = all.query(query, 0, 5), found = graph.query(query, 0, 5);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].view, expected[i].view);
      EXPECT_EQ(found[i].score, expected[i].score);
    }
  }
}

TEST(PlaceRecognizer, DoesWithoutColourWhereImagesAreGrey) {
  const PlaceRecognizerOptions options;
  PlaceRecognizer recognizer = with_places(options, 6, 1);
  const PlaceView query = describe_place(picture(2, 12, 1, 1), options.cues, true);
  EXPECT_TRUE(query.colour.empty());
  EXPECT_EQ(recognizer.query(query, 0, 5).front().view, 2);
  EXPECT_THROW(recognizer.add(describe_place(picture(7), options.cues, false)), ArgumentError);
}

TEST(PlaceRecognizer, RefusesWhatIsNoImage) {
  EXPECT_THROW((void)describe_place({}, {}, true), ArgumentError);
  EXPECT_THROW((void)describe_place(Image(9, 9, CV_16UC1), {}, true), ArgumentError);
  PlaceRecognizerOptions options;
  options.short_list = 0;
  EXPECT_THROW(PlaceRecognizer{options}, ArgumentError);
}

/// The list of a query at `place` of `views`, with a second view that looks better still.
std::vector<PlaceSimilarity> seen(int place, int views, int impostor = -1) {
  std::vector<PlaceSimilarity> list;
  for (int view = 0; view < views; ++view)
    list.push_back({view, view == place ? 2.0 : view == impostor ? 2.3 : 1.0});
  return list;
}

class SequenceEvidence : public ::testing::TestWithParam<int> {};

TEST_P(SequenceEvidence, OutweighsAnImpostorAfterSomeImages) {
  SequenceFilter filter{SequenceFilterOptions{}};
  constexpr int kViews = 40, kImages = 9;
  const int pace = GetParam();
  for (int image = 0; image < kImages; ++image) {
    const int place = 20 + pace * (image - 4);
    const int impostor = image == kImages - 1 ? 1 : -1;
    const auto list = filter.update(seen(place, kViews, impostor), 0, kViews - 1);
    ASSERT_EQ(list.size(), static_cast<std::size_t>(kViews));
    EXPECT_EQ(list.front().view, place) << "image " << image;
  }
}

INSTANTIATE_TEST_SUITE_P(BothDirectionsAndPaces, SequenceEvidence, ::testing::Values(1, -1, 2, -2));

TEST(SequenceFilter, GivesTheScoreItselfWithoutAPast) {
  SequenceFilter filter{SequenceFilterOptions{}};
  EXPECT_DOUBLE_EQ(filter.update(seen(3, 5), 0, 4).front().score, 2.0);
  filter.update(seen(4, 5), 0, 4);
  filter.restart();
  EXPECT_DOUBLE_EQ(filter.update(seen(3, 5), 0, 4).front().score, 2.0);
}

TEST(SequenceFilter, IsLessSureOfAPathThatThePresentImageHasLeft) {
  SequenceFilter filter{SequenceFilterOptions{}};
  filter.update(seen(1, 6), 0, 5);
  filter.update(seen(2, 6), 0, 5);
  const auto on_the_path = filter.update(seen(3, 6), 0, 5).front();
  const double sure = filter.confidence(on_the_path, seen(3, 6));
  EXPECT_DOUBLE_EQ(sure, 2.0);  // past and present say so alike
  const auto list = seen(0, 6);
  const auto left = filter.update(list, 0, 5).front();
  EXPECT_EQ(left.view, 4);
  EXPECT_LT(filter.confidence(left, list), left.score);
  EXPECT_DOUBLE_EQ(filter.confidence(left, {}), left.score);
}

TEST(SequenceFilter, TakesRangesThatGrowAndEndsAtAnEmptyList) {
  SequenceFilter filter{SequenceFilterOptions{}};
  EXPECT_EQ(filter.update(seen(2, 3), 0, 2).size(), 3u);
  EXPECT_EQ(filter.update(seen(3, 4), 0, 3).size(), 4u);
  EXPECT_TRUE(filter.update({}, 0, 3).empty());
  EXPECT_DOUBLE_EQ(filter.update(seen(0, 2), 0, 1).front().score, 2.0);
  EXPECT_THROW(filter.update(seen(0, 5), 0, 3), ArgumentError);
}

}  // namespace place_recognizer_test
}  // namespace placegraph
