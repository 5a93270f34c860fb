#pragma once
#include <placegraph/eval/plots/plot.h>

#include <optional>

namespace placegraph {

/// The view from above and from the side, with their places in the area of a figure.
struct TrajectoryViews {
  FigurePanel above;
  std::optional<FigurePanel> side;
  double width_px = 0, height_px = 0;  ///< size of both with their margins
};

/// Lays out the views, of which the view from above is at most this large.
TrajectoryViews trajectory_views(const Plot& plot, const Eigen::Vector2d& most_px);

/// The view from above alone, in a panel of this size.
FigurePanel view_from_above(const Plot& plot, const Eigen::Vector2d& size_px);

/// The style of every curve, in their order.
std::vector<Stroke> curve_strokes(const Plot& plot);

}  // namespace placegraph
