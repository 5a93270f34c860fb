#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/drawing/figure_settings.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

#include "svg_check.h"
#include "tests/support/message_of.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace figure_settings_test {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Colour kOrange = {213, 94, 0};

EvaluationResult judged(const std::string& name, std::uint64_t seed) {
  Random random(seed);
  const Trajectory truth = test::winding_drive(150);
  EvaluationOptions options;
  options.segments.lengths_m = {20, 40};
  return evaluate(truth, test::drifting(truth, 0.02, 0.002, random), options, name);
}

const std::vector<EvaluationResult>& two_results() {
  static const std::vector<EvaluationResult> results = {judged("ours.txt", 1),
                                                        judged("theirs.tum", 2)};
  return results;
}

std::vector<Figure> all_figures() {
  std::vector<Figure> figures;
  for (std::size_t kind = 0; kind < evaluation_plot_names().size(); ++kind)
    figures.push_back(
        figure_of(two_results(), EvaluatedTruth::kShared, static_cast<EvaluationPlot>(kind)));
  return figures;
}

/// Colours of the lines, dots and areas of a curve.
std::vector<Colour> colours_of(const Figure& figure, const std::string& series) {
  std::vector<Colour> colours;
  for (const FigurePanel& panel : figure.panels)
    for (const FigureShape& shape : panel.shapes) {
      if (const auto* line = std::get_if<FigureLine>(&shape); line && line->series == series)
        colours.push_back(line->stroke.colour);
      if (const auto* dots = std::get_if<FigureDots>(&shape); dots && dots->series == series)
        colours.push_back(dots->edge);
      if (const auto* area = std::get_if<FigureArea>(&shape); area && area->series == series)
        colours.push_back(area->fill);
    }
  return colours;
}

/// Distance of a text from the top of the picture.
double height_of(const std::string& svg, const std::string& text) {
  const std::size_t end = svg.find(">" + text + "</text>");
  EXPECT_NE(end, std::string::npos) << text;
  const std::size_t begin = svg.rfind("<text ", end);
  return test::number(svg.substr(begin, end - begin), "y");
}

TEST(FigureSettings, TheDefaultsChangeNothing) {
  for (const Figure& figure : all_figures())
    EXPECT_EQ(to_svg(with_settings(figure, {})), to_svg(figure));
}

TEST(FigureSettings, ColoursFollowTheNamesInEveryKindOfFigure) {
  FigureSettings settings;
  settings.colours = "ours #d55e00,  ground truth  #010203";
  for (const Figure& figure : all_figures()) {
    SCOPED_TRACE(figure.title);
    const Figure set = with_settings(figure, settings);
    EXPECT_FALSE(colours_of(set, "ours").empty());
    EXPECT_THAT(colours_of(set, "ours"), Each(kOrange));
    EXPECT_EQ(colours_of(set, "theirs"), colours_of(figure, "theirs"));
    EXPECT_THAT(colours_of(set, "ground truth"), Each(Colour{1, 2, 3}));
    for (const LegendEntry& entry : set.legend)
      if (entry.series == "ours") {
        EXPECT_EQ(entry.stroke.colour, kOrange);
      }
  }
}

TEST(FigureSettings, AColourReplacesThatOfTheError) {
  const Figure figure =
      figure_of({judged("ours", 1)}, EvaluatedTruth::kShared, EvaluationPlot::kOverview);
  ASSERT_TRUE(figure.panels[0].scale);
  FigureSettings settings;
  settings.colours = "ours #d55e00";
  const Figure set = with_settings(figure, settings);
  EXPECT_FALSE(set.panels[0].scale);
  EXPECT_THAT(to_svg(set), HasSubstr("#d55e00"));
}

TEST(FigureSettings, ThePictureHasTheSizeAndTextsInProportion) {
  for (const Figure& figure : all_figures())
    for (const double font_px : {10.0, 15.0, 22.0}) {
      SCOPED_TRACE(figure.title);
      FigureSettings settings;
      settings.width_px = 1500;
      settings.height_px = 1100;
      settings.font_px = font_px;
      const Figure set = with_settings(figure, settings);
      const std::string svg = to_svg(set);
      const std::string tag = svg.substr(0, svg.find('>'));
      EXPECT_EQ(test::number(tag, "width"), 1500);
      EXPECT_NEAR(set.scale * set.height_px, 1100, 1e-6);
      for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        const FigurePanel &own = figure.panels[i], &panel = set.panels[i];
        // Margins at the right and below stay.
        EXPECT_LE(panel.corner[0] + panel.size[0], set.width_px);
        if (own.corner[0] + own.size[0] == figure.width_px - 26) {
          EXPECT_NEAR(panel.corner[0] + panel.size[0], set.width_px - 26, 1e-9);
        }
        EXPECT_GT(panel.size.minCoeff(), 0);
      }
    }
}

TEST(FigureSettings, PanelsOfOneScaleKeepItAndTheirNeighboursFollow) {
  FigureSettings settings;
  settings.width_px = 900;
  settings.height_px = 1400;
  const Figure set = with_settings(all_figures()[0], settings);
  const FigurePanel& above = set.panels[0];
  ASSERT_TRUE(above.equal);
  EXPECT_NEAR(above.x.range.size() / above.size[0], above.y.range.size() / above.size[1], 1e-9);
  const FigurePanel& side = set.panels[1];
  const bool below = side.corner[0] == above.corner[0];
  EXPECT_EQ(below ? side.x.range.min : side.y.range.min,
            below ? above.x.range.min : above.y.range.min);
}

TEST(FigureSettings, LimitsAndUnitsAreThoseOfTheAxes) {
  FigureSettings settings;
  settings.length_unit = LengthUnit::kCm;
  settings.limits.position_error = {0, 250};
  settings.limits.time = {2, 4};
  const Figure set = with_settings(all_figures()[0], settings);
  int found = 0;
  for (const FigurePanel& panel : set.panels) {
    EXPECT_THAT(panel.x.label + panel.y.label, Not(HasSubstr("[m]")));
    if (panel.y.label == "position error [cm]") {
      EXPECT_EQ(panel.y.range.max, 250);
      ++found;
    }
    if (panel.x.label == "time [s]") {
      EXPECT_EQ(panel.x.range.min, 2);
    }
  }
  EXPECT_EQ(found, 2);
  // A point stays where it is in its panel.
  FigureSettings unit;
  unit.length_unit = LengthUnit::kKm;
  const Figure figure = all_figures()[0], in_km = with_settings(figure, unit);
  const auto first = [](const Figure& f) {
    const FigurePanel& panel = f.panels[0];
    const Eigen::Vector2d p = *std::get<FigureLine>(panel.shapes[0]).points[20];
    return Eigen::Vector2d((p[0] - panel.x.range.min) / panel.x.range.size(),
                           (p[1] - panel.y.range.min) / panel.y.range.size());
  };
  EXPECT_LT((first(figure) - first(in_km)).norm(), 1e-9);
}

TEST(FigureSettings, TitleNotesGridAndLegendAreAsTold) {
  FigureSettings settings;
  settings.title = "KITTI 00";
  settings.notes = false;
  settings.grid = false;
  settings.legend = LegendPlace::kBottom;
  const Figure figure = all_figures()[0];
  const std::string svg = to_svg(with_settings(figure, settings));
  const std::vector<std::string> texts = test::texts_of(svg);
  EXPECT_EQ(texts.front(), "KITTI 00");
  EXPECT_THAT(texts, Not(Contains(figure.notes.front())));
  EXPECT_THAT(texts, Contains("ground truth"));
  EXPECT_GT(height_of(svg, "ground truth"), height_of(svg, "time [s]"));
  EXPECT_LT(height_of(to_svg(figure), "ground truth"), height_of(to_svg(figure), "from above"));
  EXPECT_THAT(svg, Not(HasSubstr("#e4e4e4")));  // the grid
  EXPECT_THAT(to_svg(figure), HasSubstr("#e4e4e4"));
  settings.legend = LegendPlace::kNone;
  EXPECT_THAT(test::texts_of(to_svg(with_settings(figure, settings))),
              Not(Contains("ground truth")));
}

TEST(FigureSettings, LinesAreWiderByTheFactor) {
  FigureSettings settings;
  settings.line_width = 2;
  const Figure figure = all_figures()[1], set = with_settings(figure, settings);
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    for (std::size_t k = 0; k < figure.panels[i].shapes.size(); ++k)
      EXPECT_EQ(std::get<FigureLine>(set.panels[i].shapes[k]).stroke.width_px,
                2 * std::get<FigureLine>(figure.panels[i].shapes[k]).stroke.width_px);
}

TEST(FigureSettings, WhatMakesNoSenseIsRefused) {
  const auto message = [](const auto& change) {
    FigureSettings settings;
    change(settings);
    return test::message_of<ArgumentError>(
        [&] { (void)with_settings(all_figures()[0], settings); });
  };
  EXPECT_THAT(message([](auto& s) { s.colours = "ours blue"; }),
              HasSubstr("'ours blue' is not the name of a curve and a colour #rrggbb"));
  EXPECT_THAT(message([](auto& s) { s.colours = "#d55e00"; }), HasSubstr("'#d55e00' is not"));
  EXPECT_THAT(message([](auto& s) { s.colours = "ours #d55e00, ours #000000"; }),
              HasSubstr("'ours' stands twice"));
  EXPECT_THAT(message([](auto& s) { s.colours = "our #d55e00"; }),
              HasSubstr("no curve 'our'; it has ground truth, ours, theirs"));
  EXPECT_THAT(message([](auto& s) {
                s.limits.time = {4, 2};
              }),
              HasSubstr("limits.time: is not [least, greatest]"));
  EXPECT_THAT(message([](auto& s) { s.limits.x = {4}; }), HasSubstr("limits.x: is not"));
  EXPECT_THAT(message([](auto& s) { s.width_px = 120; }), HasSubstr("too few"));
  EXPECT_THAT(message([](auto& s) { s.font_px = 0; }), HasSubstr("font_px"));
}

}  // namespace figure_settings_test
}  // namespace placegraph
