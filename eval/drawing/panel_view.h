#pragma once
#include <placegraph/eval/drawing/figure.h>

namespace placegraph {

/// The panel in the picture.
struct PanelView {
  Eigen::Vector2d corner, size;
  Interval x, y;
  bool downwards;  ///< categories are counted from the top

  PanelView(const FigurePanel& panel, const Eigen::Vector2d& origin)
      : corner(origin + panel.corner),
        size(panel.size),
        x(panel.x.range),
        y(panel.y.range),
        downwards(!panel.y.categories.empty()) {}
  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    const double up = (p[1] - y.min) / y.size();
    return {corner[0] + (p[0] - x.min) / x.size() * size[0],
            corner[1] + (downwards ? up : 1 - up) * size[1]};
  }
  double right() const { return corner[0] + size[0]; }
  double bottom() const { return corner[1] + size[1]; }
};

}  // namespace placegraph
