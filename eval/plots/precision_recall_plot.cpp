#include <fmt/format.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/precision_recall_plot.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace {

using Eigen::Vector2d;

std::string figures_of(const PrecisionRecall& figures) {
  if (!figures.average_precision) return "no positives";
  return fmt::format("AP {:.3f}, recall {:.3f} at full precision", *figures.average_precision,
                     *figures.recall_at_full_precision);
}

}  // namespace

std::string to_svg(const PrecisionRecallPlot& plot) {
  require(!plot.curves.empty(), "precision-recall plot: no curves");
  constexpr double kSide = 560;
  Figure figure;
  figure.title = "Precision over recall";
  figure.notes = {"truth: " + plot.protocol};
  figure.width_px = kLeftMargin + kSide + kRightMargin;
  figure.height_px = 14 + kSide + kBottomMargin;
  FigurePanel panel;
  panel.corner = {kLeftMargin, 14};
  panel.size = {kSide, kSide};
  panel.x = {"recall", {0, 1.02}, false, {}};
  panel.y = {"precision", {0, 1.02}, false, {}};
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PrecisionRecall& figures = plot.curves[i].figures;
    FigureLine line{{}, curve_stroke(i), {}};
    line.stroke.width_px = 2.5;
    double recall = 0;
    for (const PrecisionRecallPoint& point : figures.curve) {
      line.points.emplace_back(Vector2d(recall, point.precision));
      line.points.emplace_back(Vector2d(point.recall, point.precision));
      recall = point.recall;
    }
    figure.legend.push_back({plot.curves[i].name + ": " + figures_of(figures), line.stroke});
    const Colour colour = line.stroke.colour;
    panel.shapes.emplace_back(std::move(line));
    if (const auto full = figures.recall_at_full_precision)
      panel.shapes.emplace_back(FigureDots{{Vector2d(*full, 1)}, 5, kWhite, colour});
  }
  figure.legend.push_back(
      {"largest recall without a false prediction", {kInk, 5}, LegendMark::kRing});
  figure.panels.push_back(std::move(panel));
  return to_svg(figure);
}

}  // namespace placegraph
