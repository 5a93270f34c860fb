#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/picture_legend.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/drawing/svg_canvas.h>
#include <placegraph/eval/drawing/text_width.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>

#include <cmath>

#include "svg_check.h"

namespace placegraph {
namespace drawing_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> texts_of_ticks(const AxisTicks& ticks) {
  std::vector<std::string> texts;
  for (const AxisTick& tick : ticks.ticks) texts.push_back(tick.text);
  return texts;
}

TEST(TextWidth, IsThatOfTheLettersAndAnUpperBoundForOthers) {
  EXPECT_DOUBLE_EQ(text_width("", 20), 0);
  EXPECT_NEAR(text_width("WWW", 100), 3 * 98.9, 1e-9);
  EXPECT_GT(text_width("W", 10), text_width("i", 10));
  EXPECT_GE(text_width("ä", 10), 6.1);
  EXPECT_LE(text_width("ä", 10), 10);
}

TEST(TextWidth, ShortensInTheMiddleAndBreaksAtSpaces) {
  EXPECT_EQ(fitted("short", 10, 100), "short");
  const std::string cut = fitted("a_very_long_name_of_an_estimate.txt", 10, 100);
  EXPECT_LE(text_width(cut, 10), 100);
  EXPECT_THAT(cut, StartsWith("a_very"));
  EXPECT_THAT(cut, HasSubstr("…"));
  EXPECT_EQ(cut.substr(cut.size() - 4), ".txt");
  for (const std::string& line : wrapped("some words of which a line has two or three", 10, 80))
    EXPECT_LE(text_width(line, 10), 80);
  EXPECT_TRUE(wrapped("", 10, 80).empty());
}

TEST(TextWidth, ReplacesBytesThatAreNoText) {
  EXPECT_THAT(code_points("a\xc3\xa4"), ElementsAre(U'a', U'ä'));
  EXPECT_THAT(code_points("a\xff\xc3"), ElementsAre(U'a', 0xfffd, 0xfffd));
  EXPECT_THAT(code_points("\xed\xa0\x80"), Contains(0xfffd));  // half of a surrogate pair
  for (const char32_t c : {U'a', U'ä', U'中', U'\x1f600'})
    EXPECT_THAT(code_points(utf8(c)), ElementsAre(c));
}

TEST(AxisTicks, HaveTheSameNumberOfDecimals) {
  EXPECT_THAT(texts_of_ticks(linear_ticks({0, 2}, 4)),
              ElementsAre("0.0", "0.5", "1.0", "1.5", "2.0"));
  EXPECT_THAT(texts_of_ticks(linear_ticks({-0.031, 0.02}, 6)),
              ElementsAre("-0.03", "-0.02", "-0.01", "0.00", "0.01", "0.02"));
  EXPECT_TRUE(linear_ticks({1, 1}, 5).ticks.empty());
}

TEST(AxisTicks, SubtractWhatLongNumbersHaveInCommon) {
  const AxisTicks ticks = linear_ticks({5412034.2, 5412061.8}, 5);
  EXPECT_EQ(ticks.offset, 5412000);
  EXPECT_EQ(ticks.ticks.front().text, "40");
  EXPECT_EQ(ticks.ticks.front().at, 5412040);
  EXPECT_EQ(ticks.label("y [m]"), "y [m], less 5412000");
  EXPECT_EQ(linear_ticks({0, 300}, 5).label("y [m]"), "y [m]");
}

TEST(AxisTicks, OfLogarithmsNameTensAndOthersIfThereIsRoom) {
  EXPECT_THAT(texts_of_ticks(log_ticks({0, 1}, 100, 46)), ElementsAre("1", "", "", "10"));
  EXPECT_THAT(texts_of_ticks(log_ticks({0, 1}, 400, 46)), ElementsAre("1", "2", "5", "10"));
}

TEST(Intervals, NeverHaveNoSize) {
  EXPECT_EQ(with_margin({}, 0.1).size(), 1);
  EXPECT_GT(with_margin({5e6, 5e6}, 0.1).size(), 1e-4);
  EXPECT_EQ(with_margin({0, 5.68e-14}, 0.1).size(), 1e-6);
  EXPECT_DOUBLE_EQ(with_margin({0, 10}, 0.1).size(), 12);
}

TEST(Comparable, GivesNumbersThatCanBeComparedTheSameDecimals) {
  EXPECT_THAT(comparable({1.3034, 3.738}), ElementsAre("1.30", "3.74"));
  EXPECT_THAT(comparable({0.0123, 12.3}), ElementsAre("0.0123", "12.3000"));
  EXPECT_THAT(comparable({5.68e-14, 1.5}), ElementsAre("< 0.0001", "1.50"));
  EXPECT_THAT(comparable({0, 250}), ElementsAre("0", "250"));
}

Figure figure_with(const std::vector<std::string>& names) {
  Figure figure;
  figure.title = "a < b & c > d";
  figure.width_px = 640;
  figure.height_px = 400;
  FigurePanel panel;
  panel.corner = {kLeftMargin, kTopMargin};
  panel.size = {500, 290};
  panel.heading = "a heading";
  panel.x = {"time [s]", {0, 10}, false, {}};
  panel.y = {"value [m]", {-1, 1}, false, {}};
  panel.shapes.emplace_back(
      FigureLine{{Eigen::Vector2d(0, 0), std::nullopt, Eigen::Vector2d(5, NAN),
                  Eigen::Vector2d(6, 0), Eigen::Vector2d(7, 1)},
                 curve_stroke(0),
                 {}});
  figure.panels.push_back(panel);
  for (std::size_t i = 0; i < names.size(); ++i)
    figure.legend.push_back({names[i], curve_stroke(i)});
  return figure;
}

TEST(Figure, KeepsAllTextsInsideThePicture) {
  std::vector<std::string> names;
  for (int i = 0; i < 20; ++i)
    names.push_back("estimate_" + std::to_string(i) + "_of_a_study_with_a_long_name_" +
                    std::string(static_cast<std::size_t>(5 * i), 'W'));
  const Figure figure = figure_with(names);
  const std::string svg = to_svg(figure);
  test::expect_good_svg(svg);
  EXPECT_THAT(test::texts_of(svg), Contains("a < b & c > d"));
  EXPECT_THAT(test::texts_of(svg), Contains(StartsWith("estimate_19")));
  EXPECT_EQ(svg, to_svg(figure));
}

TEST(Figure, WrapsALongTitleAndNotes) {
  Figure figure = figure_with({"one"});
  const double height = test::number(to_svg(figure), "height");
  for (int i = 0; i < 30; ++i) figure.title += " word";
  figure.notes = {std::string(500, 'n')};
  const std::string svg = to_svg(figure);
  test::expect_good_svg(svg);
  EXPECT_GT(test::number(svg, "height"), height + 40);
}

TEST(Figure, TakesTextsThatAreNoXml) {
  const std::string svg = to_svg(figure_with({"\x01\xff<&>\"'"}));
  test::expect_good_svg(svg);
  EXPECT_FALSE(svg_pixels(svg, 1, "a test").empty());
}

TEST(Figure, HasEntriesInColumnsWhereThereIsRoom) {
  const double one = test::number(to_svg(figure_with({"a"})), "height");
  EXPECT_EQ(test::number(to_svg(figure_with({"a", "b", "c"})), "height"), one);
  EXPECT_GT(test::number(to_svg(figure_with(std::vector<std::string>(40, "abc"))), "height"), one);
}

TEST(ScaleColour, RisesInLightness) {
  double last = -1;
  for (double share = 0; share <= 1; share += 0.05) {
    const Colour c = scale_colour(share);
    const double lightness = 0.21 * c.red + 0.72 * c.green + 0.07 * c.blue;
    EXPECT_GT(lightness, last - 1);
    last = lightness;
  }
  EXPECT_EQ(scale_colour(-1), scale_colour(0));
  EXPECT_EQ(scale_colour(7), scale_colour(1));
}

TEST(CurveStroke, RepeatsNoStyleForTwentyFourCurves) {
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(curve_stroke(i).colour == curve_stroke(k).colour &&
                   curve_stroke(i).dash == curve_stroke(k).dash);
}

TEST(PictureBytes, AreOfTheKindOfTheName) {
  const std::string svg = to_svg(figure_with({"one"}));
  EXPECT_EQ(picture_bytes(svg, "a.svg"), svg);
  const Image png = decode_png(picture_bytes(svg, "a.png"), DecodedPixels::kEightBits);
  EXPECT_EQ(png.cols, test::number(svg, "width"));
  EXPECT_EQ(png.rows, test::number(svg, "height"));
  const std::string pdf = picture_bytes(svg, "a.pdf");
  EXPECT_THAT(pdf, StartsWith("%PDF"));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  EXPECT_EQ(pdf, picture_bytes(svg, "b.pdf"));
  EXPECT_THROW((void)picture_bytes(svg, "a.gif"), ArgumentError);
  EXPECT_THROW((void)picture_bytes("no svg", "a.png"), ArgumentError);
}

TEST(PictureLegend, LiesBelowThePicture) {
  const Image picture(40, 50, CV_8UC3, cv::Scalar(10, 20, 30));
  const Image whole = with_legend(picture, {area_entry("road", {1, 2, 3})}, "a test");
  EXPECT_EQ(whole.cols, 320);
  EXPECT_GT(whole.rows, 60);
  EXPECT_EQ(whole.at<cv::Vec3b>(39, 49), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(whole.at<cv::Vec3b>(0, 319), cv::Vec3b(255, 255, 255));
  int marked = 0;
  for (int v = 40; v < whole.rows; ++v)
    for (int u = 0; u < whole.cols; ++u) marked += whole.at<cv::Vec3b>(v, u) == cv::Vec3b(3, 2, 1);
  EXPECT_GT(marked, 100);
  EXPECT_FALSE(area_colour(0) == area_colour(1));
}

/// The names of the clip paths of a picture with one clipped panel.
std::string clip_of_panel(double width_px) {
  SvgCanvas canvas(300, 200);
  canvas.begin_clip({10, 20}, {width_px, 100});
  canvas.end_clip();
  const std::string svg = canvas.finish();
  const auto begin = svg.find("id=\"") + 4;
  return svg.substr(begin, svg.find('"', begin) - begin);
}

TEST(SvgCanvas, ClipsPicturesInOnePageByTheirOwnPanels) {
  EXPECT_EQ(clip_of_panel(50), clip_of_panel(50));
  EXPECT_NE(clip_of_panel(50), clip_of_panel(50.1));
}

}  // namespace drawing_test
}  // namespace placegraph
