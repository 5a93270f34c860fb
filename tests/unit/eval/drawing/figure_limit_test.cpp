#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/svg_canvas.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

#include "svg_check.h"

namespace placegraph {
namespace figure_limit_test {

using Eigen::Vector2d;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kMostBytes = 240'000;

Figure figure_with(std::vector<FigureShape> shapes) {
  Figure figure;
  figure.title = "a long drive";
  figure.width_px = 800;
  figure.height_px = 700;
  FigurePanel& panel = figure.panels.emplace_back();
  panel.corner = {84, 36};
  panel.size = {690, 600};
  panel.x = {"x", {0, 690}, false, {}};
  panel.y = {"y", {0, 600}, false, {}};
  panel.shapes = std::move(shapes);
  return figure;
}

/// A line in a colour of its own over the panel, whose errors jump from point to point.
FigureLine noisy_line(int count) {
  Random random(5);
  FigureLine line{{}, {{1, 2, 3}, 3}, {}};
  for (int i = 0; i < count; ++i) {
    const double angle = 6 * std::acos(-1) * i / count;
    line.points.emplace_back(
        Vector2d(345 + 300 * std::cos(angle), 300 + 250 * std::sin(0.99 * angle)));
    line.shares.push_back(random.uniform(0, 0.4));
  }
  return line;
}

TEST(FigureLimit, LeavesAFigureOfFewPointsAsItIs) {
  const std::string svg = to_svg(figure_with({noisy_line(900)}));
  EXPECT_THAT(svg, Not(HasSubstr("<path")));
  EXPECT_GT(test::tags_of(svg, "polyline").size(), 800u);
}

TEST(FigureLimit, BoundsTheBytesOfLines) {
  for (const int count : {5000, 50'000, 200'000}) {
    const std::string svg = to_svg(figure_with({noisy_line(count)}));
    EXPECT_LE(svg.size(), kMostBytes) << count;
    EXPECT_THAT(svg, HasSubstr("<path transform"));
    test::expect_good_svg(svg);
  }
}

TEST(FigureLimit, ShowsASingleErrorAndAGap) {
  FigureLine line = noisy_line(100'000);
  line.shares[30'000] = 1;
  const Vector2d worst = *line.points[30'000];
  for (std::size_t i = 60'000; i < 61'000; ++i) line.points[i] = std::nullopt;
  const std::string svg = to_svg(figure_with({line}));
  std::string paths;
  for (const std::string& tag : test::tags_of(svg, "path"))
    if (test::attribute(tag, "stroke") == "#e1d514") paths = test::attribute(tag, "d");
  const std::vector<double> at = test::numbers_in(paths.substr(0, paths.find('l')));
  ASSERT_GE(at.size(), 2u);
  const double above_px = test::number(test::tags_of(svg, "rect").back(), "y") - 36;
  EXPECT_NEAR(at[0] / 10, 84 + worst[0], 3);
  EXPECT_NEAR(at[1] / 10, above_px + 36 + 600 - worst[1], 3);
}

TEST(FigureLimit, BoundsEveryLineOfManyAndNamesATolerance) {
  Random random(6);
  std::vector<FigureShape> shapes;
  for (int k = 0; k < 12; ++k) {
    FigureLine line{{}, {{1, 2, k}, 1}, {}};
    for (int i = 0; i < 3000; ++i)
      line.points.emplace_back(Vector2d(random.uniform(0, 690), random.uniform(0, 600)));
    shapes.emplace_back(std::move(line));
  }
  FigureLine simple{{Vector2d(3, 4), Vector2d(600, 500)}, {{9, 9, 9}, 1}, {}};
  shapes.emplace_back(simple);
  const std::string svg = to_svg(figure_with(shapes));
  EXPECT_LE(svg.size(), kMostBytes);
  EXPECT_THAT(svg, HasSubstr("px of what is drawn"));
  EXPECT_THAT(svg, HasSubstr("#090909"));
  test::expect_good_svg(svg);
}

TEST(FigureLimit, BoundsTheBytesOfDots) {
  Random random(7);
  FigureDots places{{}, 2.5, {255, 255, 255}, {}}, start{{{20, 30}}, 5, {255, 255, 255}, {}};
  for (int i = 0; i < 100'000; ++i)
    places.points.emplace_back(random.uniform(0, 690), random.uniform(0, 600));
  const std::string svg = to_svg(figure_with({places, start}));
  EXPECT_LE(svg.size(), kMostBytes);
  const std::size_t dots = test::tags_of(svg, "circle").size();
  EXPECT_GT(dots, 200u);
  EXPECT_EQ(test::number(test::tags_of(svg, "circle").back(), "r"), 5);
  test::expect_good_svg(svg);
}

TEST(SvgCanvas, WritesPathsInTenthsRelativeToThePointBefore) {
  EXPECT_EQ(path_in_tenths({{{1, 2}, {1.52, 1}, {NAN, 3}, {1.5, 1}}, {{-3, -4}, {-3, 4.04}}}),
            "M10 20l5-10l0 0M-30-40l0 80");
  EXPECT_EQ(path_in_tenths({{{NAN, 2}}}), "");
  // Rounding does not add up along a line.
  std::vector<Vector2d> line;
  for (int i = 0; i <= 1000; ++i) line.emplace_back(0.034 * i, 0);
  double x = 0;
  const std::vector<double> numbers = test::numbers_in(path_in_tenths({line}));
  for (std::size_t i = 0; i < numbers.size(); i += 2) x += numbers[i];
  EXPECT_EQ(x, 340);
}

}  // namespace figure_limit_test
}  // namespace placegraph
