#include "tests/bench/rate_plot.h"

#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <fstream>

namespace placegraph::bench {
namespace {

using Eigen::Vector2d;

FigurePanel panel_of(const RatePanel& panel, const std::string& label, double most,
                     std::vector<LegendEntry>& legend) {
  FigurePanel drawn;
  drawn.heading = panel.heading;
  drawn.x = {label, {0, most}, false, {}};
  drawn.y = {"rate [%]", {0, 102}, false, {}};
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const RateCurve& curve = panel.curves[i];
    FigureLine line{{}, curve_stroke(i), {}};
    FigureDots dots{{}, 3.5, kWhite, line.stroke.colour};
    for (std::size_t k = 0; k < curve.at.size(); ++k) {
      dots.points.emplace_back(curve.at[k], 100 * curve.rate[k]);
      line.points.emplace_back(dots.points.back());
    }
    if (std::ranges::find(legend, curve.name, &LegendEntry::text) == legend.end())
      legend.push_back({curve.name, line.stroke});
    drawn.shapes.emplace_back(std::move(line));
    drawn.shapes.emplace_back(std::move(dots));
  }
  return drawn;
}

}  // namespace

void write_rate_plot(const std::string& path, const std::string& title, const std::string& label,
                     const std::vector<RatePanel>& panels, int columns) {
  require(!panels.empty() && columns > 0, "rate plot: no panels");
  double most = 0;
  for (const RatePanel& panel : panels)
    for (const RateCurve& curve : panel.curves)
      for (const double at : curve.at) most = std::max(most, at);
  require(most > 0, "rate plot: nothing to show");
  const Vector2d size(410, 300),
      cell = size + Vector2d(kLeftMargin + kRightMargin, kTopMargin + kBottomMargin);
  const auto across = static_cast<std::size_t>(columns);
  Figure figure;
  figure.title = title;
  figure.width_px = cell[0] * columns;
  figure.height_px = cell[1] * static_cast<double>((panels.size() + across - 1) / across);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    FigurePanel panel = panel_of(panels[i], label, most, figure.legend);
    panel.corner = {cell[0] * static_cast<double>(i % across) + kLeftMargin,
                    cell[1] * static_cast<double>(i / across) + kTopMargin};
    panel.size = size;
    figure.panels.push_back(std::move(panel));
  }
  std::ofstream file(path, std::ios::binary);
  file << picture_bytes(to_svg(figure), path);
  require(file.good(), path + ": cannot be written");
}

}  // namespace placegraph::bench
