#include <gtest/gtest.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/panel_drawing.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/svg_canvas.h>

#include "svg_check.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace panel_drawing_test {

using Eigen::Vector2d;

constexpr double kRounding_px = 0.051;  // coordinates are written with one decimal

FigurePanel panel_with(FigureShape shape) {
  FigurePanel panel;
  panel.corner = {90, 40};
  panel.size = {400, 200};
  panel.x = {"x", {-2, 6}, false, {}};
  panel.y = {"y", {10, 20}, false, {}};
  panel.shapes.push_back(std::move(shape));
  return panel;
}

std::string drawn(const FigurePanel& panel, const Vector2d& origin = Vector2d::Zero()) {
  SvgCanvas canvas(600, 400);
  draw_panel(canvas, panel, origin);
  return canvas.finish();
}

/// The lines of this colour.
std::vector<std::string> lines_of(const std::string& svg, const std::string& colour) {
  std::vector<std::string> lines;
  for (const std::string& tag : test::tags_of(svg, "polyline"))
    if (test::attribute(tag, "stroke") == colour) lines.push_back(test::attribute(tag, "points"));
  return lines;
}

TEST(PanelDrawing, MapsTheRangesOntoThePanelWithYUpwards) {
  const FigureDots dots{{{-2, 10}, {6, 20}, {2, 12.5}, {NAN, 12}}, 3, {}, {}};
  const std::string svg = drawn(panel_with(dots), {7, 11});
  const std::vector<std::string> discs = test::tags_of(svg, "circle");
  const std::vector<Vector2d> expected = {{97, 251}, {497, 51}, {297, 201}};
  ASSERT_EQ(discs.size(), expected.size());  // the point that is none is left out
  for (std::size_t i = 0; i < discs.size(); ++i) {
    EXPECT_NEAR(test::number(discs[i], "cx"), expected[i][0], kRounding_px);
    EXPECT_NEAR(test::number(discs[i], "cy"), expected[i][1], kRounding_px);
  }
  test::expect_good_svg(svg);
}

TEST(PanelDrawing, CountsCategoriesFromTheTop) {
  FigurePanel panel = panel_with(FigureDots{{{0, 0}, {0, 1}}, 3, {}, {}});
  panel.y = {"", {-0.5, 1.5}, false, {"first", "second"}};
  const std::string svg = drawn(panel);
  const std::vector<std::string> discs = test::tags_of(svg, "circle");
  EXPECT_NEAR(test::number(discs.at(0), "cy"), 90, kRounding_px);
  EXPECT_NEAR(test::number(discs.at(1), "cy"), 190, kRounding_px);
  for (const std::string& tag : test::tags_of(svg, "text")) {
    const std::size_t text = svg.find(tag) + tag.size() + 1;
    if (svg.substr(text, 5) == "first") {
      EXPECT_NEAR(test::number(tag, "y"), 90, 6);
    }
    if (svg.substr(text, 6) == "second") {
      EXPECT_NEAR(test::number(tag, "y"), 190, 6);
    }
  }
}

TEST(PanelDrawing, ALineHasAStretchForEachRunOfPoints) {
  Random random = test::seeded_random(9);
  for (int trial = 0; trial < 50; ++trial) {
    FigureLine line{{}, {{1, 2, 3}, 1}, {}};
    std::size_t runs = 0;
    for (int i = 0; i < 60; ++i) {
      if (random.index(4) == 0)
        line.points.emplace_back(random.index(2) == 0 ? std::nullopt
                                                      : std::optional(Vector2d(NAN, 12)));
      else
        line.points.emplace_back(Vector2d(-2 + 0.1 * i, random.uniform(10, 20)));
      const auto is_point = [](const auto& p) { return p && p->allFinite(); };
      runs += is_point(line.points.back()) && (i == 0 || !is_point(*(line.points.end() - 2)));
    }
    EXPECT_EQ(lines_of(drawn(panel_with(line)), "#010203").size(), runs);
  }
}

TEST(PanelDrawing, StretchesOfAColouredLineMeetAndCoverIt) {
  FigureLine line{{}, {{1, 2, 3}, 1}, {}};
  for (int i = 0; i <= 40; ++i) {
    line.points.emplace_back(Vector2d(-2 + 0.2 * i, 15));
    line.shares.push_back(i / 40.0);
  }
  std::vector<double> ends;
  std::size_t stretches = 0;
  for (const std::string& tag : test::tags_of(drawn(panel_with(line)), "polyline")) {
    const std::vector<double> at = test::numbers_in(test::attribute(tag, "points"));
    const std::string colour = test::attribute(tag, "stroke");
    if (at.at(1) != 140 || colour == "#e4e4e4" || colour == "#787878") continue;  // the axes
    if (!ends.empty()) {
      EXPECT_EQ(at[0], ends.back());
    }
    if (ends.empty()) {
      EXPECT_NEAR(at[0], 90, kRounding_px);
    }
    ends.push_back(at[at.size() - 2]);
    ++stretches;
  }
  EXPECT_EQ(stretches, 25u);                          // the levels of the scale
  EXPECT_NEAR(ends.back(), 490, 0.5 + kRounding_px);  // a single point is 0.5 px long
}

TEST(PanelDrawing, EqualAxesWidenOneRangeAroundItsMiddle) {
  Random random = test::seeded_random(10);
  for (int trial = 0; trial < 100; ++trial) {
    FigurePanel panel = panel_with(FigureDots{});
    panel.size = {random.uniform(100, 900), random.uniform(100, 900)};
    panel.x.range = resized({3, 3}, random.uniform(0.1, 50));
    panel.y.range = resized({-8, -8}, random.uniform(0.1, 50));
    const Interval x = panel.x.range, y = panel.y.range;
    make_equal(panel);
    EXPECT_NEAR(panel.x.range.size() / panel.size[0], panel.y.range.size() / panel.size[1], 1e-12);
    EXPECT_NEAR(panel.x.range.middle(), 3, 1e-9);
    EXPECT_NEAR(panel.y.range.middle(), -8, 1e-9);
    EXPECT_GE(panel.x.range.size(), x.size() - 1e-9);
    EXPECT_GE(panel.y.range.size(), y.size() - 1e-9);
    EXPECT_TRUE(std::abs(panel.x.range.size() - x.size()) < 1e-9 ||
                std::abs(panel.y.range.size() - y.size()) < 1e-9);
  }
}

}  // namespace panel_drawing_test
}  // namespace placegraph
