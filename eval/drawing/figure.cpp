#include <fmt/format.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/figure_detail.h>
#include <placegraph/eval/drawing/legend.h>
#include <placegraph/eval/drawing/panel_drawing.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/drawing/svg_canvas.h>
#include <placegraph/eval/drawing/text_width.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr double kSide = 24, kTitleLine = 28, kNoteLine = 21;
constexpr double kSeen_px = 1;  ///< a smaller tolerance is not seen

double largest(const std::vector<ShapeTolerances>& tolerances_px) {
  double most_px = 0;
  for (const ShapeTolerances& panel : tolerances_px)
    for (const double each : panel) most_px = std::max(most_px, each);
  return most_px;
}

}  // namespace

void Interval::add(double value) {
  if (!std::isfinite(value)) return;
  min = std::min(min, value);
  max = std::max(max, value);
}

void make_equal(FigurePanel& panel) {
  const double unit_per_px =
      std::max({panel.x.range.size() / panel.size[0], panel.y.range.size() / panel.size[1], 1e-12});
  panel.x.range = resized(panel.x.range, unit_per_px * panel.size[0]);
  panel.y.range = resized(panel.y.range, unit_per_px * panel.size[1]);
  panel.equal = true;
}

std::string to_svg(const Figure& figure, double detail) {
  const double room = figure.width_px - 2 * kSide;
  const std::vector<std::string> title = wrapped(figure.title, kTitlePx, room);
  const std::vector<ShapeTolerances> tolerances_px = shape_tolerances(figure, detail);
  std::vector<std::string> written = figure.notes, notes;
  if (const double most_px = largest(tolerances_px); most_px > kSeen_px)
    written.push_back(fmt::format(
        "thinned: what is left out lies within {:.0f} px of what is drawn", std::ceil(most_px)));
  for (const std::string& note : written)
    for (std::string& line : wrapped(note, kTextPx, room)) notes.push_back(std::move(line));
  const bool top = figure.legend_place == LegendPlace::kTop;
  const Legend legend(
      figure.legend_place == LegendPlace::kNone ? std::vector<LegendEntry>() : figure.legend, room);
  const double above = 12 + kTitleLine * static_cast<double>(title.size()) +
                       kNoteLine * static_cast<double>(notes.size()),
               legend_px = legend.height_px() > 0 ? legend.height_px() + 10 : 0;
  SvgCanvas canvas(figure.width_px, above + legend_px + figure.height_px, figure.scale);
  double y = 12;
  for (const std::string& line : title) {
    canvas.text({kSide, y + 0.75 * kTitleLine}, line, kTitlePx, kInk, TextAnchor::kLeft);
    y += kTitleLine;
  }
  for (const std::string& line : notes) {
    canvas.text({kSide, y + 0.75 * kNoteLine}, line, kTextPx, kFaint, TextAnchor::kLeft);
    y += kNoteLine;
  }
  legend.draw(canvas, {kSide, above + (top ? 6 : figure.height_px)});
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    draw_panel(canvas, figure.panels[i], {0, above + (top ? legend_px : 0)}, tolerances_px[i]);
  return canvas.finish();
}

}  // namespace placegraph
