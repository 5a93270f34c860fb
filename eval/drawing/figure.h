#pragma once
#include <placegraph/eval/drawing/legend.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/svg_canvas.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace placegraph {

/// A line in the coordinates of a panel, with gaps at missing points.
struct FigureLine {
  std::vector<std::optional<Eigen::Vector2d>> points;
  Stroke stroke;
  std::vector<double> shares;  ///< for scale_colour(), at each point; empty: the stroke's colour
};

struct FigureDots {
  std::vector<Eigen::Vector2d> points;
  double radius_px = 2.5;
  Colour fill = {255, 255, 255}, edge;
};

/// Filled rings; what lies in a ring within another one is a hole.
struct FigureArea {
  std::vector<std::vector<Eigen::Vector2d>> rings;
  Colour fill;
  double opacity = 1;
};

/// A text around a point, white behind it.
struct FigureText {
  Eigen::Vector2d at;
  std::string text;
};

using FigureShape = std::variant<FigureLine, FigureDots, FigureArea, FigureText>;

struct FigureAxis {
  std::string label;  ///< quantity and unit
  Interval range;     ///< what the panel shows; decimal logarithms if `logarithmic`
  bool logarithmic = false;
  /// Names at 0, 1, 2 ... in place of numbers, from the top down; for a vertical axis.
  std::vector<std::string> categories;
};

/// The values of the colours of a panel.
struct FigureScale {
  std::string label;
  Interval range;
};

/// Axes with shapes, the first of which lie below the others.
struct FigurePanel {
  /// The inside of the panel in the area of the figure. Margins of plot_style.h must be free around
  /// it, kBarMargin at the right if it has a scale.
  Eigen::Vector2d corner = Eigen::Vector2d::Zero(), size = Eigen::Vector2d::Zero();
  std::string heading;
  FigureAxis x, y;
  std::vector<FigureShape> shapes;
  /// Texts beside points where there is room, the first ones first.
  std::vector<FigureText> labels;
  std::optional<FigureScale> scale;
};

/// A title, notes, a legend, and an area with panels.
struct Figure {
  std::string title;
  std::vector<std::string> notes;  ///< lines below the title
  std::vector<LegendEntry> legend;
  double width_px = 0, height_px = 0;  ///< size of the area
  std::vector<FigurePanel> panels;
};

/// Makes the scale of both axes equal by widening the range of one.
void make_equal(FigurePanel& panel);

/// The picture as SVG text. It is as wide as the area, and higher by title, notes and legend.
std::string to_svg(const Figure& figure);

}  // namespace placegraph
