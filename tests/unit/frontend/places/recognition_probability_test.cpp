#include <gtest/gtest.h>
#include <placegraph/frontend/places/verification/recognition_probability.h>
#include <placegraph/graph/core/error.h>

#include <cmath>

#include "tests/support/seed.h"

namespace placegraph {
namespace recognition_probability_test {

const NearViews kNext = [](int a, int b) { return std::abs(a - b) <= 1; };
bool any(int) { return true; }

TEST(RecognitionProbability, AnAnswerStandsOutAboveWhatIsNotNearIt) {
  const auto lone = lone_evidence({{{3, 2.0}, {4, 1.9}, {7, 1.5}, {9, 0.5}}, {}}, 10);
  const ViewEstimate estimate = view_estimate(lone[0], kNext, any);
  EXPECT_EQ(estimate.view, 3);
  EXPECT_DOUBLE_EQ(estimate.margin, 0.5);
  EXPECT_TRUE(estimate.agreed);
  EXPECT_EQ(view_estimate(lone[0], kNext, [](int view) { return view > 5; }).view, 7);
  EXPECT_EQ(view_estimate(lone[1], kNext, any).view, -1);
}

TEST(RecognitionProbability, SidesThatAreForDifferentViewsDoNotAgree) {
  const ViewEvidence evidence{{5, 0, 0, 0, 3}, {0, 0, 0, 0, 3}};
  const ViewEstimate estimate = view_estimate(evidence, kNext, any);
  EXPECT_EQ(estimate.view, 4);
  EXPECT_FALSE(estimate.agreed);
}

TEST(RecognitionProbability, AWrongImageAmongOthersIsOutvotedFromBothSides) {
  // Ten images along views 0 ... 9; the fifth by itself looks like view 20.
  std::vector<std::vector<PlaceSimilarity>> lists;
  for (int i = 0; i < 10; ++i) lists.push_back({{i, 1.0}, {20, i == 4 ? 1.6 : 0.0}, {29, 0.0}});
  const auto evidence = sequence_evidence(lists, 30, {});
  EXPECT_EQ(view_estimate(lone_evidence(lists, 30)[4], kNext, any).view, 20);
  EXPECT_EQ(view_estimate(evidence[4], kNext, any).view, 4);
  EXPECT_EQ(view_estimate(evidence[0], kNext, any).view, 0);
}

// Margins drawn as the model has them: what is said with probability p is right so often.
TEST(RecognitionProbability, ProbabilitiesAreHonestWhereTheModelHolds) {
  Random random = test::seeded_random(8);
  constexpr double kMean = 0.1, kLargest = 1;
  const auto wrong = [&] {
    return ViewEstimate{0, -kMean * std::log(1 - random.uniform()), random.index(10) == 0};
  };
  const auto right = [&] { return ViewEstimate{0, random.uniform(0, kLargest / 0.9), true}; };
  std::vector<ViewEstimate> wrongs, rights;
  for (int i = 0; i < 2000; ++i) {
    wrongs.push_back(wrong());
    rights.push_back(right());
  }
  const RecognitionProbability odds(wrongs, rights);
  constexpr int kTrials = 40000;
  int message = 0, wrongly = 0;
  double expected = 0;
  for (int i = 0; i < kTrials; ++i) {
    const bool is_right = i % 2 == 0;
    const double p = odds.probabilities({is_right ? right() : wrong()}, kNext, 0).front();
    if (p < 0.7 || p > 0.95) continue;
    ++message;
    wrongly += !is_right;
    expected += 1 - p;
  }
  // A tenth of the right margins is beyond the largest: densities are off by so much.
  ASSERT_GT(message, 500);
  const double sigma = std::sqrt(expected);
  EXPECT_NEAR(wrongly, expected, 4 * sigma + 0.15 * expected);
}

TEST(RecognitionProbability, AnswersThatFollowEachOtherShareTheirOdds) {
  const RecognitionProbability odds({{0, 0.1, false}, {0, 0.1, false}},
                                    {{0, 1, true}, {0, 1, true}});
  const ViewEstimate sure{5, 0.9, true}, unsure{5, 0.1, true};
  const double alone = odds.probabilities({unsure}, kNext, 3).front();
  const auto together = odds.probabilities({sure, unsure, sure}, kNext, 3);
  EXPECT_GT(together[1], alone);
  EXPECT_DOUBLE_EQ(together[0], together[1]);
  // Another place before and after: nothing is shared.
  ViewEstimate elsewhere = sure;
  elsewhere.view = 50;
  EXPECT_DOUBLE_EQ(odds.probabilities({elsewhere, unsure, elsewhere}, kNext, 3)[1], alone);
  EXPECT_EQ(odds.probabilities({ViewEstimate{}}, kNext, 3).front(), 0);
}

TEST(RecognitionProbability, WithoutAnswersThereIsNothingToLearnFrom) {
  EXPECT_THROW(RecognitionProbability({}, {{0, 1, true}}), ArgumentError);
}

}  // namespace recognition_probability_test
}  // namespace placegraph
