#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/figure_detail.h>
#include <placegraph/eval/drawing/svg_canvas.h>

namespace placegraph {

/// Draws a panel of which the area begins at `origin`. Shapes with a tolerance are thinned.
void draw_panel(SvgCanvas& canvas, const FigurePanel& panel, const Eigen::Vector2d& origin,
                const ShapeTolerances& tolerances_px = {});

}  // namespace placegraph
