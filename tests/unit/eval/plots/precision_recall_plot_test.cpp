#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/plots/precision_recall_plot.h>
#include <placegraph/graph/core/error.h>

#include "../drawing/svg_check.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace precision_recall_plot_test {

using testing::Contains;
using testing::StartsWith;

/// The points of the first curve as recall and precision, read from the picture.
std::vector<Eigen::Vector2d> points_of(const std::string& svg) {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> frame, line;
  for (const std::string& tag : test::tags_of(svg, "polyline")) {
    const std::vector<double> numbers = test::numbers_in(test::attribute(tag, "points"));
    if (test::attribute(tag, "stroke") == "#0072b2" && numbers.size() > line.size()) line = numbers;
    if (test::attribute(tag, "stroke") == "#787878") frame = numbers;  // the last one
  }
  for (std::size_t i = 0; i + 1 < line.size(); i += 2)
    points.emplace_back(1.02 * (line[i] - frame[0]) / (frame[2] - frame[0]),
                        1.02 * (frame[5] - line[i + 1]) / (frame[5] - frame[1]));
  return points;
}

TEST(PrecisionRecallSvg, TheAreaBelowItsStepsIsTheAveragePrecision) {
  Random random = test::seeded_random(17);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<ScoredPrediction> predictions;
    int correct = 1;
    for (int i = 0; i < 60; ++i) {
      predictions.push_back({random.uniform(), random.uniform() < 0.6});
      correct += predictions.back().correct;
    }
    const PrecisionRecall figures = precision_recall(predictions, correct);
    const std::string svg = to_svg(PrecisionRecallPlot{{{"a", figures}}, "by hand"});
    const std::vector<Eigen::Vector2d> points = points_of(svg);
    double area = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      area += (points[i][0] - points[i - 1][0]) * 0.5 * (points[i][1] + points[i - 1][1]);
    EXPECT_NEAR(area, *figures.average_precision, 2e-3);  // 560 px, a tenth of a pixel each
    EXPECT_THAT(test::texts_of(svg), Contains("truth: by hand"));
  }
}

TEST(PrecisionRecallSvg, ACurveWithoutPositivesSaysSo) {
  const std::string svg =
      to_svg(PrecisionRecallPlot{{{"none", precision_recall({{0.5, false}}, 0)}}, ""});
  test::expect_good_svg(svg);
  EXPECT_THAT(test::texts_of(svg), Contains("none: no positives"));
  EXPECT_THROW(to_svg(PrecisionRecallPlot{}), ArgumentError);
}

}  // namespace precision_recall_plot_test
}  // namespace placegraph
