#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/figure_detail.h>
#include <placegraph/eval/drawing/label_room.h>
#include <placegraph/eval/drawing/panel_drawing.h>
#include <placegraph/eval/drawing/panel_view.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/drawing/svg_canvas.h>
#include <placegraph/eval/drawing/text_width.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

AxisTicks ticks_of(const FigureAxis& axis, double size_px, double room_px) {
  if (!axis.categories.empty()) return {};
  if (axis.logarithmic) return log_ticks(axis.range, size_px / axis.range.size(), room_px);
  constexpr int kMost = 10;
  return linear_ticks(axis.range, std::clamp(static_cast<int>(size_px / room_px), 3, kMost));
}

void draw_x_axis(SvgCanvas& canvas, const FigureAxis& axis, const PanelView& view, bool grid) {
  const AxisTicks ticks = ticks_of(axis, view.size[0], 64);
  for (const AxisTick& tick : ticks.ticks) {
    const double at = view({tick.at, view.y.min})[0];
    if (grid) canvas.line({{at, view.corner[1]}, {at, view.bottom()}}, {kGrid});
    canvas.line({{at, view.bottom()}, {at, view.bottom() + 5}}, {kFrame});
    canvas.text({at, view.bottom() + 20}, tick.text, kTickPx, kInk, TextAnchor::kMiddle);
  }
  canvas.text({view.corner[0] + view.size[0] / 2, view.bottom() + 43},
              fitted(ticks.label(axis.label), kTextPx, view.size[0] + kRightMargin), kTextPx, kInk,
              TextAnchor::kMiddle);
}

void draw_categories(SvgCanvas& canvas, const FigureAxis& axis, const PanelView& view) {
  for (std::size_t i = 0; i < axis.categories.size(); ++i)
    canvas.text(view({view.x.min, static_cast<double>(i)}) + Vector2d(-10, 5),
                fitted(axis.categories[i], kTickPx, view.corner[0] - 20), kTickPx, kInk,
                TextAnchor::kRight);
}

void draw_y_axis(SvgCanvas& canvas, const FigureAxis& axis, const PanelView& view, bool grid) {
  const AxisTicks ticks = ticks_of(axis, view.size[1], 46);
  double width = 0;
  for (const AxisTick& tick : ticks.ticks) {
    const double at = view({view.x.min, tick.at})[1];
    if (grid) canvas.line({{view.corner[0], at}, {view.right(), at}}, {kGrid});
    canvas.line({{view.corner[0] - 5, at}, {view.corner[0], at}}, {kFrame});
    canvas.text({view.corner[0] - 9, at + 5}, tick.text, kTickPx, kInk, TextAnchor::kRight);
    width = std::max(width, text_width(tick.text, kTickPx));
  }
  const double left = view.corner[0] - std::min(kLeftMargin - 20, 9 + width + 12);
  canvas.text({left, view.corner[1] + view.size[1] / 2},
              fitted(ticks.label(axis.label), kTextPx, view.size[1] + kTopMargin), kTextPx, kInk,
              TextAnchor::kMiddle, true);
}

void draw(SvgCanvas& canvas, const FigureLine& line, const PanelView& view, double tolerance_px) {
  const auto lines = drawn_lines(line, view, tolerance_px);
  for (const DrawnLine& drawn : lines.value()) {
    if (tolerance_px > 0)
      canvas.lines(drawn.stretches, drawn.stroke);
    else
      canvas.line(drawn.stretches.front(), drawn.stroke);
  }
}

void draw(SvgCanvas& canvas, const FigureDots& dots, const PanelView& view, double tolerance_px) {
  const double edge_px = dots.radius_px < 4 ? 1.5 : 2;
  const std::vector<Vector2d> centres = drawn_dots(dots, view, tolerance_px);
  if (tolerance_px > 0 && centres.size() > 1) {
    canvas.discs(centres, dots.radius_px, dots.fill, dots.edge, edge_px);
    return;
  }
  for (const Vector2d& centre : centres)
    canvas.disc(centre, dots.radius_px, dots.fill, dots.edge, edge_px);
}

void draw(SvgCanvas& canvas, const FigureArea& area, const PanelView& view, double) {
  std::vector<std::vector<Vector2d>> rings = area.rings;
  for (std::vector<Vector2d>& ring : rings)
    for (Vector2d& p : ring) p = view(p);
  canvas.area(rings, area.fill, area.opacity);
}

void draw(SvgCanvas& canvas, const FigurePicture& picture, const PanelView& view, double) {
  const Vector2d corner = view(picture.corner);
  canvas.picture(picture.source, picture.pixels, corner,
                 view(picture.corner + picture.right) - corner,
                 view(picture.corner + picture.down) - corner, picture.opacity);
}

/// In several lines if it contains line breaks.
void draw(SvgCanvas& canvas, const FigureText& text, const PanelView& view, double) {
  constexpr double kLine = 1.25 * kTickPx;
  std::vector<std::string> lines = {""};
  for (const char c : text.text) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  }
  double width = 0;
  for (const std::string& line : lines) width = std::max(width, text_width(line, kTickPx));
  const double height = kLine * static_cast<double>(lines.size());
  const Vector2d most = view.corner + view.size - Vector2d(width / 2 + 5, height / 2 + 3),
                 least = view.corner + Vector2d(width / 2 + 5, height / 2 + 3);
  const Vector2d at = view(text.at).cwiseMin(most).cwiseMax(least);
  canvas.area(
      {{at + Vector2d(-width / 2 - 3, -height / 2), at + Vector2d(width / 2 + 3, -height / 2),
        at + Vector2d(width / 2 + 3, height / 2), at + Vector2d(-width / 2 - 3, height / 2)}},
      kWhite, 0.75);
  for (std::size_t i = 0; i < lines.size(); ++i)
    canvas.text(at + Vector2d(0, kLine * (static_cast<double>(i) + 0.78) - height / 2), lines[i],
                kTickPx, kInk, TextAnchor::kMiddle);
}

void draw_labels(SvgCanvas& canvas, const FigurePanel& panel, const PanelView& view) {
  if (panel.labels.empty()) return;
  constexpr double kLabelPx = 12.5, kDisc_px = 3.5;
  LabelRoom room(view.corner, view.size);
  for (const FigureShape& shape : panel.shapes) {
    if (const auto* line = std::get_if<FigureLine>(&shape))
      for (std::size_t i = 1; i < line->points.size(); ++i)
        if (line->points[i - 1] && line->points[i])
          room.occupy_line(view(*line->points[i - 1]), view(*line->points[i]));
    if (const auto* dots = std::get_if<FigureDots>(&shape))
      for (const Vector2d& point : dots->points)
        room.occupy(view(point) - Vector2d(kDisc_px, kDisc_px), {2 * kDisc_px, 2 * kDisc_px});
  }
  for (const FigureText& label : panel.labels) {
    const Vector2d size(text_width(label.text, kLabelPx), 0.78 * kLabelPx);
    if (const auto corner = room.place_beside(view(label.at), size))
      canvas.text(*corner + Vector2d(0, size[1]), label.text, kLabelPx, kInk, TextAnchor::kLeft);
  }
}

void draw_scale(SvgCanvas& canvas, const FigureScale& scale, const PanelView& view) {
  constexpr double kWidth = 14;
  constexpr int kParts = 48;
  const Vector2d corner(view.right() + 16, view.corner[1]);
  const double part = view.size[1] / kParts;
  for (int i = 0; i < kParts; ++i) {
    const double top = view.bottom() - (i + 1) * part;
    canvas.area({{{corner[0], top},
                  {corner[0] + kWidth, top},
                  {corner[0] + kWidth, top + part + (i > 0 ? 0.5 : 0)},
                  {corner[0], top + part + (i > 0 ? 0.5 : 0)}}},
                scale_colour((i + 0.5) / kParts), 1);
  }
  double width = 0;
  const AxisTicks ticks =
      linear_ticks(scale.range, std::max(2, static_cast<int>(view.size[1] / 56)));
  for (const AxisTick& tick : ticks.ticks) {
    const double at =
        view.bottom() - (tick.at - scale.range.min) / scale.range.size() * view.size[1];
    canvas.line({{corner[0] + kWidth, at}, {corner[0] + kWidth + 5, at}}, {kFrame});
    canvas.text({corner[0] + kWidth + 8, at + 5}, tick.text, kTickPx, kInk, TextAnchor::kLeft);
    width = std::max(width, text_width(tick.text, kTickPx));
  }
  canvas.text({corner[0] + kWidth + std::min(width + 26, kBarMargin - 36),
               view.corner[1] + view.size[1] / 2},
              fitted(ticks.label(scale.label), kTextPx, view.size[1] + kTopMargin), kTextPx, kInk,
              TextAnchor::kMiddle, true);
}

}  // namespace

void draw_panel(SvgCanvas& canvas, const FigurePanel& panel, const Vector2d& origin,
                const ShapeTolerances& tolerances_px) {
  const PanelView view(panel, origin);
  canvas.text(view.corner + Vector2d(0, -11),
              fitted(panel.heading, kHeadingPx, view.size[0] + kRightMargin - 6), kHeadingPx, kInk,
              TextAnchor::kLeft);
  draw_x_axis(canvas, panel.x, view, panel.grid);
  if (panel.y.categories.empty())
    draw_y_axis(canvas, panel.y, view, panel.grid);
  else
    draw_categories(canvas, panel.y, view);
  canvas.begin_clip(view.corner, view.size);
  for (std::size_t i = 0; i < panel.shapes.size(); ++i)
    std::visit(
        [&](const auto& shape) {
          draw(canvas, shape, view, tolerances_px.empty() ? 0 : tolerances_px[i]);
        },
        panel.shapes[i]);
  canvas.end_clip();
  draw_labels(canvas, panel, view);
  const Vector2d a = view.corner, b = view.corner + view.size;
  canvas.line({a, {b[0], a[1]}, b, {a[0], b[1]}, a}, {kFrame});
  if (panel.scale) draw_scale(canvas, *panel.scale, view);
}

}  // namespace placegraph
