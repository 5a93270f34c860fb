#include <fmt/format.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>
#include <placegraph/eval/internal/plots/plot_style.h>
#include <placegraph/eval/internal/plots/precision_recall_plot.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr int kSquareWidth = 900, kSquareHeight = 800;
constexpr Colour kCurvePalette[] = {{0, 114, 178},   {213, 94, 0},  {0, 158, 115},
                                    {204, 121, 167}, {230, 159, 0}, {86, 180, 233}};
constexpr double kSide = 640;
const Vector2d kCorner(110, 70);  // corner of the square from (0, 0) to (1, 1)

Vector2d px(double recall, double precision) {
  return {kCorner[0] + recall * kSide, kCorner[1] + (1 - precision) * kSide};
}

void draw_axes(PlotCanvas& canvas) {
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double value = tenth / 10.0;
    canvas.line({px(value, 0), px(value, 1)}, kGrid, 1);
    canvas.line({px(0, value), px(1, value)}, kGrid, 1);
    const std::string name = fmt::format("{:.1f}", value);
    canvas.text(px(value, 0) + Vector2d(0, 25), name, kTextPx, kInk, TextAnchor::kMiddle);
    canvas.text(px(0, value) + Vector2d(-11, 6), name, kTextPx, kInk, TextAnchor::kRight);
  }
  canvas.line({px(0, 0), px(1, 0), px(1, 1), px(0, 1), px(0, 0)}, kFrame, 1);
  canvas.text(px(0.5, 0) + Vector2d(0, 56), "recall", kTextPx, kInk, TextAnchor::kMiddle);
  canvas.text(px(0, 1) + Vector2d(0, -14), "precision", kTextPx, kInk, TextAnchor::kLeft);
}

void draw_curve(PlotCanvas& canvas, const PrecisionRecall& figures, Colour colour) {
  std::vector<Vector2d> points;
  double recall = 0;
  for (const PrecisionRecallPoint& point : figures.curve) {
    points.push_back(px(recall, point.precision));
    points.push_back(px(point.recall, point.precision));
    recall = point.recall;
  }
  if (!points.empty()) canvas.line(points, colour, 2.5);
  if (const auto full = figures.recall_at_full_precision)
    canvas.disc(px(*full, 1), 5, kWhite, colour);
}

std::string figures_of(const PrecisionRecall& figures) {
  if (!figures.average_precision) return "no positives";
  return fmt::format("AP {:.3f}, recall {:.3f} at full precision", *figures.average_precision,
                     *figures.recall_at_full_precision);
}

std::string draw(const PrecisionRecallPlot& plot, PlotCanvas& canvas) {
  require(!plot.curves.empty(), "precision-recall plot: no curves");
  canvas.text({kSquareWidth / 2.0, 34}, plot.title, kTitlePx, kInk, TextAnchor::kMiddle);
  draw_axes(canvas);
  for (std::size_t i = 0; i < plot.curves.size(); ++i)
    draw_curve(canvas, plot.curves[i].figures, kCurvePalette[i % std::size(kCurvePalette)]);
  double y = px(0, 0)[1] - 16 - 26 * static_cast<double>(plot.curves.size() - 1);
  for (std::size_t i = 0; i < plot.curves.size(); ++i, y += 26) {
    const double x = kCorner[0] + 16;
    canvas.line({{x, y - 6}, {x + 34, y - 6}}, kCurvePalette[i % std::size(kCurvePalette)], 2.5);
    canvas.text({x + 46, y}, plot.curves[i].name + ": " + figures_of(plot.curves[i].figures),
                kTextPx, kInk, TextAnchor::kLeft);
  }
  return canvas.encode();
}

}  // namespace

std::string to_svg(const PrecisionRecallPlot& plot) {
  return draw(plot, *svg_canvas(kSquareWidth, kSquareHeight));
}

std::string to_png(const PrecisionRecallPlot& plot) {
  return draw(plot, *png_canvas(kSquareWidth, kSquareHeight));
}

}  // namespace placegraph
