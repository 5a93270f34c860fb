#include <fmt/format.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/growth_plot.h>
#include <placegraph/graph/core/error.h>

#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

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

FigurePanel panel_of(const GrowthPanel& panel, const std::string& size_label) {
  Interval sizes, values;
  FigurePanel result;
  FigureLine proportion{{}, {kReference, 1.5}, {}};
  const GrowthCurve& first = panel.curves.front();
  for (const double decades : {-10.0, 10.0})
    proportion.points.emplace_back(
        Vector2d(std::log10(first.sizes[0]) + decades, std::log10(first.values[0]) + decades));
  result.shapes.emplace_back(std::move(proportion));
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const GrowthCurve& curve = panel.curves[i];
    FigureLine line{{}, curve_stroke(i), {}};
    FigureDots dots{{}, 4, kWhite, line.stroke.colour};
    for (std::size_t k = 0; k < curve.sizes.size(); ++k) {
      const Vector2d point(std::log10(curve.sizes[k]), std::log10(curve.values[k]));
      sizes.add(point[0]);
      values.add(point[1]);
      line.points.emplace_back(point);
      dots.points.push_back(point);
    }
    result.shapes.emplace_back(std::move(line));
    result.shapes.emplace_back(std::move(dots));
  }
  constexpr double kMargin_decades = 0.25;
  result.x = {size_label, resized(sizes, sizes.size() + 2 * kMargin_decades), true, {}};
  result.y = {panel.heading, resized(values, values.size() + 2 * kMargin_decades), true, {}};
  return result;
}

}  // namespace

std::string to_svg(const GrowthPlot& plot) {
  check(plot);
  constexpr double kWidth_px = 620, kHeight_px = 440;
  Figure figure;
  figure.title = plot.title;
  const auto add_legend = [&](const std::string& name, const Stroke& stroke) {
    for (const LegendEntry& entry : figure.legend)
      if (entry.text == name && entry.stroke.colour == stroke.colour) return;
    figure.legend.push_back({name, stroke});
  };
  for (const GrowthPanel& panel : plot.panels) {
    FigurePanel drawn = panel_of(panel, plot.size_label);
    drawn.corner = {figure.width_px + kLeftMargin, kTopMargin};
    drawn.size = {kWidth_px, kHeight_px};
    make_equal(drawn);
    drawn.heading = panel.heading;
    figure.panels.push_back(std::move(drawn));
    figure.width_px += kLeftMargin + kWidth_px + kRightMargin;
    for (std::size_t i = 0; i < panel.curves.size(); ++i)
      add_legend(panel.curves[i].name, curve_stroke(i));
  }
  add_legend("in proportion", {kReference, 1.5});
  figure.height_px = kTopMargin + kHeight_px + kBottomMargin;
  return to_svg(figure);
}

}  // namespace placegraph
