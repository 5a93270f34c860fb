#include <fmt/format.h>
#include <placegraph/eval/internal/plots/growth_plot.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>
#include <placegraph/eval/internal/plots/plot_style.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr int kPanelWidth = 800, kPanelHeight = 640;
constexpr Colour kProportion = {150, 150, 150};
constexpr Colour kGrowthPalette[] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}};

void check(const GrowthPlot& plot) {
  require(!plot.panels.empty(), "growth plot: no panels");
  for (const GrowthPanel& panel : plot.panels) {
    require(!panel.curves.empty(), "growth plot: a panel without curves");
    for (const GrowthCurve& curve : panel.curves) {
      require(!curve.sizes.empty() && curve.sizes.size() == curve.values.size(),
              "growth plot: '" + curve.name + "' has different numbers of values and sizes");
      for (const std::vector<double>& numbers : {curve.sizes, curve.values})
        for (const double number : numbers)
          require(number > 0 && std::isfinite(number),
                  "growth plot: '" + curve.name + "' is not positive");
    }
  }
}

// The range of one axis in decades, and its position in the picture.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
};

struct Area {
  Vector2d corner;
  double width, height, px_per_decade;
  Axis x, y;
  Vector2d px(double size, double value) const {
    return {corner[0] + (std::log10(size) - x.low) * px_per_decade,
            corner[1] + height - (std::log10(value) - y.low) * px_per_decade};
  }
};

// The same scale on both axes, with the data in the middle.
Area area_of(const GrowthPanel& panel, double left) {
  Area area{{left + 100, 92}, kPanelWidth - 140.0, kPanelHeight - 92.0 - 76, 0, {}, {}};
  for (const GrowthCurve& curve : panel.curves)
    for (std::size_t i = 0; i < curve.sizes.size(); ++i) {
      area.x.add(curve.sizes[i]);
      area.y.add(curve.values[i]);
    }
  const double margin = 0.25;
  area.px_per_decade = std::min(area.width / (area.x.high - area.x.low + 2 * margin),
                                area.height / (area.y.high - area.y.low + 2 * margin));
  for (auto [axis, size] : {std::pair{&area.x, area.width}, std::pair{&area.y, area.height}}) {
    const double middle = 0.5 * (axis->low + axis->high), half = 0.5 * size / area.px_per_decade;
    axis->low = middle - half;
    axis->high = middle + half;
  }
  return area;
}

// Lines at 1, 2 and 5 times powers of ten, numbers at as many of them as there is room for.
void draw_axis(PlotCanvas& canvas, const Area& area, bool horizontal) {
  const Axis& axis = horizontal ? area.x : area.y;
  const bool dense = area.px_per_decade > (horizontal ? 260 : 120);
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, decade);
      if (std::log10(value) < axis.low || std::log10(value) > axis.high) continue;
      const double shift = (std::log10(value) - axis.low) * area.px_per_decade;
      const bool named = factor == 1 || dense;
      if (horizontal) {
        const double at = area.corner[0] + shift, bottom = area.corner[1] + area.height;
        canvas.line({{at, area.corner[1]}, {at, bottom}}, kGrid, 1);
        if (named)
          canvas.text({at, bottom + 25}, fmt::format("{:g}", value), kTextPx, kInk,
                      TextAnchor::kMiddle);
      } else {
        const double at = area.corner[1] + area.height - shift;
        canvas.line({{area.corner[0], at}, {area.corner[0] + area.width, at}}, kGrid, 1);
        if (named)
          canvas.text({area.corner[0] - 11, at + 6}, fmt::format("{:g}", value), kTextPx, kInk,
                      TextAnchor::kRight);
      }
    }
}

void draw_curve(PlotCanvas& canvas, const Area& area, const GrowthCurve& curve, Colour colour) {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < curve.sizes.size(); ++i)
    points.push_back(area.px(curve.sizes[i], curve.values[i]));
  if (points.size() > 1) canvas.line(points, colour, 2.5);
  for (const Vector2d& point : points) canvas.disc(point, 4, kWhite, colour);
}

void draw_legend(PlotCanvas& canvas, const Area& area, const GrowthPanel& panel) {
  double y = area.corner[1] + 30;
  const auto entry = [&](const std::string& name, Colour colour) {
    canvas.line({{area.corner[0] + 16, y - 6}, {area.corner[0] + 50, y - 6}}, colour, 2.5);
    canvas.text({area.corner[0] + 62, y}, name, kTextPx, kInk, TextAnchor::kLeft);
    y += 26;
  };
  for (std::size_t i = 0; i < panel.curves.size(); ++i)
    entry(panel.curves[i].name, kGrowthPalette[i % std::size(kGrowthPalette)]);
  entry("in proportion", kProportion);
}

void draw_panel(PlotCanvas& canvas, const GrowthPanel& panel, const std::string& size_label,
                double left) {
  const Area area = area_of(panel, left);
  const Vector2d size(area.width, area.height), end = area.corner + size;
  canvas.rectangle(area.corner, size, kWhite, kWhite);
  draw_axis(canvas, area, true);
  draw_axis(canvas, area, false);
  canvas.begin_clip(area.corner, size);
  const GrowthCurve& first = panel.curves.front();
  const auto proportion = [&](double decades) {
    const double factor = std::pow(10.0, decades);
    return area.px(factor * first.sizes[0], factor * first.values[0]);
  };
  canvas.line({proportion(-10), proportion(10)}, kProportion, 1.5);
  for (std::size_t i = 0; i < panel.curves.size(); ++i)
    draw_curve(canvas, area, panel.curves[i], kGrowthPalette[i % std::size(kGrowthPalette)]);
  canvas.end_clip();
  draw_legend(canvas, area, panel);
  canvas.line({area.corner, {end[0], area.corner[1]}, end, {area.corner[0], end[1]}, area.corner},
              kFrame, 1);
  canvas.text({area.corner[0] + area.width / 2, area.corner[1] - 14}, panel.heading, kTextPx, kInk,
              TextAnchor::kMiddle);
  canvas.text({area.corner[0] + area.width / 2, end[1] + 52}, size_label, kTextPx, kInk,
              TextAnchor::kMiddle);
}

int width_of(const GrowthPlot& plot) { return kPanelWidth * static_cast<int>(plot.panels.size()); }

std::string draw(const GrowthPlot& plot, PlotCanvas& canvas) {
  canvas.text({width_of(plot) / 2.0, 38}, plot.title, kTitlePx, kInk, TextAnchor::kMiddle);
  for (std::size_t i = 0; i < plot.panels.size(); ++i)
    draw_panel(canvas, plot.panels[i], plot.size_label, kPanelWidth * static_cast<double>(i));
  return canvas.encode();
}

}  // namespace

std::string to_svg(const GrowthPlot& plot) {
  check(plot);
  return draw(plot, *svg_canvas(width_of(plot), kPanelHeight));
}

std::string to_png(const GrowthPlot& plot) {
  check(plot);
  return draw(plot, *png_canvas(width_of(plot), kPanelHeight));
}

}  // namespace placegraph
