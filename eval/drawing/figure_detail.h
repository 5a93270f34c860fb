#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/panel_view.h>

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace placegraph {

/// How far dropped points and dots of a shape may lie from what is drawn of it [px]; 0: it is drawn
/// whole. In the order of the shapes of a panel; empty: all are drawn whole.
using ShapeTolerances = std::vector<double>;

/// Stretches of a line that have one stroke. Coordinates in pixels of the picture.
struct DrawnLine {
  Stroke stroke;
  std::vector<std::vector<Eigen::Vector2d>> stretches;
};

/// What is drawn of a line: a single stretch each, in the order of the line, if it is not thinned,
/// else all stretches of a colour together; stretches of a line meet in a point.
/// Nothing if a thinned line has more than `most_points`.
std::optional<std::vector<DrawnLine>> drawn_lines(
    const FigureLine& line, const PanelView& view, double tolerance_px,
    std::size_t most_points = std::numeric_limits<std::size_t>::max());

/// The centres of the dots that are drawn [px].
std::vector<Eigen::Vector2d> drawn_dots(const FigureDots& dots, const PanelView& view,
                                        double tolerance_px);

/// The tolerances of the shapes of every panel with which a figure has a limited number of bytes.
/// All are 0 where lines and dots are few. Elsewhere each shape has the same share of the bytes,
/// what simple ones leave is for the others, and the smallest of a series of tolerances that fits.
/// `detail`: share of that number.
std::vector<ShapeTolerances> shape_tolerances(const Figure& figure, double detail = 1);

}  // namespace placegraph
