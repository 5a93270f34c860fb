#include <gtest/gtest.h>
#include <placegraph/eval/loops/precision_recall.h>
#include <placegraph/eval/plots/precision_recall_plot.h>
#include <placegraph/graph/core/error.h>

#include <cmath>

namespace placegraph {
namespace precision_recall_test {

TEST(PrecisionRecall, SumsPrecisionOverTheRecallGained) {
  // 4 to be found: precision 1, 1, 2/3, 3/4 at recall 1/4, 2/4, 2/4, 3/4.
  const PrecisionRecall figures =
      precision_recall({{0.9, true}, {0.5, false}, {0.8, true}, {0.4, true}}, 4);
  ASSERT_EQ(figures.curve.size(), 4u);
  EXPECT_DOUBLE_EQ(figures.curve[2].precision, 2.0 / 3);
  EXPECT_DOUBLE_EQ(figures.curve[3].recall, 0.75);
  EXPECT_DOUBLE_EQ(figures.curve[3].threshold, 0.4);
  EXPECT_DOUBLE_EQ(figures.average_precision.value(), 0.25 + 0.25 + 0.25 * 0.75);
  EXPECT_DOUBLE_EQ(figures.recall_at_full_precision.value(), 0.5);
  EXPECT_DOUBLE_EQ(figures.f1_max.value(), 0.75);
}

TEST(PrecisionRecall, LetsEqualScoresEnterTogether) {
  const PrecisionRecall figures = precision_recall({{1, true}, {1, false}, {0, true}}, 2);
  ASSERT_EQ(figures.curve.size(), 2u);
  EXPECT_DOUBLE_EQ(figures.curve[0].precision, 0.5);
  EXPECT_DOUBLE_EQ(figures.average_precision.value(), 0.5 * 0.5 + 0.5 * 2 / 3);
  EXPECT_DOUBLE_EQ(figures.recall_at_full_precision.value(), 0);
}

TEST(PrecisionRecall, FindsNothingWithoutAnswersAndSaysNothingWithoutPositives) {
  EXPECT_DOUBLE_EQ(precision_recall({}, 3).average_precision.value(), 0);
  const PrecisionRecall none = precision_recall({{1, false}}, 0);
  EXPECT_FALSE(none.average_precision);
  EXPECT_FALSE(none.recall_at_full_precision);
  EXPECT_EQ(none.curve.at(0).misses, 1);
}

TEST(PrecisionRecall, RefusesWhatCannotBe) {
  EXPECT_THROW((void)precision_recall({{1, true}, {2, true}}, 1), ArgumentError);
  EXPECT_THROW((void)precision_recall({{std::nan(""), true}}, 1), ArgumentError);
}

TEST(PrecisionRecallPlot, NamesEachSystemWithItsFigures) {
  const PrecisionRecall figures = precision_recall({{1, true}}, 2);
  const std::string svg = to_svg(PrecisionRecallPlot{{{"ours", figures}, {"theirs", {}}}, "a list of matches"});
  EXPECT_NE(svg.find("ours: AP 0.500, recall 0.500 at full precision"), std::string::npos);
  EXPECT_NE(svg.find("theirs: no positives"), std::string::npos);
  EXPECT_NE(svg.find("truth: a list of matches"), std::string::npos);
  EXPECT_NE(svg.find(">precision<"), std::string::npos);
  EXPECT_THROW((void)to_svg(PrecisionRecallPlot{}), ArgumentError);
}

}  // namespace precision_recall_test
}  // namespace placegraph
