#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/loops/own_recognizer.h>

#include <limits>

namespace placegraph {
namespace own_recognizer_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

/// Answers with the views of a list that are asked for, or with all of the list.
struct ListedViews final : PlaceRetrieval {
  std::vector<PlaceSimilarity> list;
  bool whole = false;
  std::vector<std::pair<int, int>> asked;
  std::vector<std::pair<FrameId, Image>> added;
  FrameId begun;

  void begin_frame(FrameId frame) override { begun = frame; }
  void clear() override {}
  void add(const Image& image) override { added.emplace_back(begun, image); }
  std::vector<PlaceSimilarity> query(const Image&, int first, int last) override {
    asked.emplace_back(first, last);
    if (whole) return list;
    std::vector<PlaceSimilarity> answer;
    for (const PlaceSimilarity& each : list)
      if (each.view >= first && each.view <= last) answer.push_back(each);
    return answer;
  }
};

std::vector<int> views_of(const std::vector<PlaceSimilarity>& answer) {
  std::vector<int> views;
  for (const PlaceSimilarity& each : answer) views.push_back(each.view);
  return views;
}

TEST(AskRecognizer, AsksForEachStretchOfAllowedViewsAndSortsTheAnswers) {
  ListedViews recognizer;
  recognizer.list = {{0, 0.1}, {1, -3}, {4, 7}, {6, 0.5}, {8, 2}};
  const auto allowed = [](int view) { return view < 2 || (view > 4 && view != 7); };
  EXPECT_THAT(views_of(ask_recognizer(recognizer, {}, FrameId(0), 9, 10, allowed)),
              ElementsAre(8, 6, 0, 1));
  EXPECT_THAT(recognizer.asked, ElementsAre(Pair(0, 1), Pair(5, 6), Pair(8, 8)));
  EXPECT_THAT(views_of(ask_recognizer(recognizer, {}, FrameId(0), 9, 2, allowed)),
              ElementsAre(8, 6));
}

TEST(AskRecognizer, DoesNotAskWhereNoViewIsAllowed) {
  ListedViews recognizer;
  recognizer.list = {{0, 1}};
  EXPECT_THAT(ask_recognizer(recognizer, {}, FrameId(0), 5, 10, [](int) { return false; }),
              IsEmpty());
  EXPECT_THAT(ask_recognizer(recognizer, {}, FrameId(0), 0, 10, [](int) { return true; }),
              IsEmpty());
  EXPECT_THAT(recognizer.asked, IsEmpty());
}

TEST(AskRecognizer, RefusesAnswersThatBreakTheContract) {
  const auto refusal = [](std::vector<PlaceSimilarity> list) -> std::string {
    ListedViews recognizer;
    recognizer.list = std::move(list);
    recognizer.whole = true;
    try {
      (void)ask_recognizer(recognizer, {}, FrameId(0), 5, 10, [](int view) { return view > 0; });
    } catch (const ArgumentError& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(refusal({{2, 1}, {5, 1}}), HasSubstr("view 5, which is not one of 1 to 4"));
  EXPECT_THAT(refusal({{0, 1}}), HasSubstr("view 0"));
  EXPECT_THAT(refusal({{3, std::numeric_limits<double>::quiet_NaN()}}), HasSubstr("score nan"));
  EXPECT_THAT(refusal({{3, std::numeric_limits<double>::infinity()}}), HasSubstr("score inf"));
  EXPECT_THAT(refusal({{3, 1}, {2, 1}, {3, 2}}), HasSubstr("view 3 twice"));
}

TEST(RecognizerImage, IsInColourWhereTheFrameIs) {
  Frame frame;
  frame.image = Image(2, 3, CV_8UC1);
  EXPECT_EQ(recognizer_image(frame).data, frame.image.data);
  frame.colour = Image(2, 3, CV_8UC3);
  EXPECT_EQ(recognizer_image(frame).data, frame.colour.data);
}

TEST(AskRecognizer, AnnouncesTheFrameOfTheImage) {
  ListedViews recognizer;
  ask_recognizer(recognizer, {}, FrameId(77), 3, 1, [](int) { return true; });
  EXPECT_EQ(recognizer.begun, FrameId(77));
}

TEST(ShowKeyframes, StoresTheImagesOfTheKeyframesInTheirOrder) {
  Map map;
  for (const int frame : {3, 8, 9}) {
    Keyframe keyframe;
    keyframe.frame = FrameId(frame);
    map.keyframes.push_back(keyframe);
  }
  const auto frame_of = [](FrameId id) {
    Frame frame;
    frame.image = Image(2, 2, CV_8UC1, cv::Scalar(static_cast<double>(id.value())));
    if (id == FrameId(8)) frame.colour = Image(2, 2, CV_8UC3, cv::Scalar(1, 2, 3));
    return frame;
  };
  ListedViews recognizer;
  show_keyframes(&recognizer, map, frame_of);
  ASSERT_EQ(recognizer.added.size(), 3u);
  EXPECT_EQ(recognizer.added[0].first, FrameId(3));
  EXPECT_EQ(recognizer.added[0].second.at<std::uint8_t>(0, 0), 3);
  EXPECT_EQ(recognizer.added[1].first, FrameId(8));
  EXPECT_EQ(recognizer.added[1].second.channels(), 3);
  EXPECT_EQ(recognizer.added[2].second.at<std::uint8_t>(1, 1), 9);
  EXPECT_THROW(show_keyframes(&recognizer, map, {}), ArgumentError);
  EXPECT_NO_THROW(show_keyframes(nullptr, map, {}));
}

}  // namespace own_recognizer_test
}  // namespace placegraph
