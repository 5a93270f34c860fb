#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A colour, each part from 0 to 255.
struct Colour {
  int red = 0;    ///< share of red
  int green = 0;  ///< share of green
  int blue = 0;   ///< share of blue
  bool operator==(const Colour&) const = default;
};

/// How a line is drawn.
struct Stroke {
  Colour colour;          ///< its colour
  double width_px = 1;    ///< its width [px]
  double opacity = 1;     ///< from 0, nothing is seen, to 1
  std::string dash = {};  ///< lengths of dashes and gaps [px], as "6 4"; empty: a whole line
};

/// A range of numbers; without any, the least is above the greatest.
struct Interval {
  double min = std::numeric_limits<double>::infinity();   ///< the least
  double max = -std::numeric_limits<double>::infinity();  ///< the greatest
  void add(double value);  ///< a value that is not finite adds nothing
  /// Whether it holds no number.
  bool empty() const { return !(max >= min); }
  /// Distance of its ends.
  double size() const { return max - min; }
  /// Mean of its ends.
  double middle() const { return 0.5 * (min + max); }
};

/// The mark of an entry of a legend.
enum class LegendMark {
  kLine,  ///< a line
  kRing,  ///< a circle
  kDisc,  ///< a filled circle
  kArea,  ///< a filled area
  kScale  ///< a line in the colours of a scale
};

/// A mark as it is in the picture, and what it means.
/// Of a ring the width of the stroke is its radius; kScale is a line in the colours of a scale.
struct LegendEntry {
  std::string text;                     ///< what the mark means
  Stroke stroke;                        ///< its colour and width
  LegendMark mark = LegendMark::kLine;  ///< what is drawn before the text
  std::string series = {};              ///< the curve it is of, see FigureLine
};

/// A colour for a share from 0 (dark blue) to 1 (yellow).
/// Its lightness rises evenly, so that colour-blind readers and grey prints order the values.
Colour scale_colour(double share);

/// A line in the coordinates of a panel, with gaps at missing points.
struct FigureLine {
  std::vector<std::optional<Eigen::Vector2d>> points;  ///< nothing: a gap
  Stroke stroke;                                       ///< how it is drawn
  std::vector<double> shares;  ///< for scale_colour(), at each point; empty: the stroke's colour
  /// Name of the estimate or truth that it shows, by which settings find it; empty: of none.
  std::string series = {};
};

/// Discs at points in the coordinates of a panel.
struct FigureDots {
  std::vector<Eigen::Vector2d> points;  ///< their centres
  double radius_px = 2.5;               ///< their radius [px]
  Colour fill = {255, 255, 255};        ///< colour of the inside
  Colour edge;                          ///< colour of the edge
  std::string series = {};              ///< as of a line
};

/// Filled rings; what lies in a ring within another one is a hole.
struct FigureArea {
  std::vector<std::vector<Eigen::Vector2d>> rings;  ///< in the coordinates of the panel
  Colour fill;                                      ///< colour of the inside
  double opacity = 1;                               ///< from 0, nothing is seen, to 1
  std::string series = {};                          ///< as of a line
};

/// A picture, each pixel a parallelogram in the coordinates of the panel.
struct FigurePicture {
  std::string source;      ///< "data:image/png;base64,..."
  Eigen::Vector2d pixels;  ///< columns and rows
  Eigen::Vector2d corner;  ///< outer corner of the first pixel of the first row
  Eigen::Vector2d right;   ///< from a pixel to its right neighbour
  Eigen::Vector2d down;    ///< from a pixel to the one below it
  double opacity = 1;      ///< from 0, nothing is seen, to 1
};

/// A text around a point, white behind it.
struct FigureText {
  Eigen::Vector2d at;  ///< the point, in the coordinates of the panel
  std::string text;    ///< what is written
};

/// What a panel shows.
using FigureShape = std::variant<FigureLine, FigureDots, FigureArea, FigureText, FigurePicture>;

/// An axis of a panel.
struct FigureAxis {
  std::string label;         ///< quantity and unit
  Interval range;            ///< what the panel shows; decimal logarithms if `logarithmic`
  bool logarithmic = false;  ///< whether equal factors have equal lengths
  /// Names at 0, 1, 2 ... in place of numbers, from the top down; for a vertical axis.
  std::vector<std::string> categories;
};

/// The values of the colours of a panel.
struct FigureScale {
  std::string label;  ///< quantity and unit
  Interval range;     ///< values of the first and the last colour
};

/// Axes with shapes, the first of which lie below the others.
struct FigurePanel {
  /// The inside of the panel in the area of the figure. Margins of plot_style.h must be free around
  /// it, kBarMargin at the right if it has a scale.
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< upper left corner [px]
  Eigen::Vector2d size = Eigen::Vector2d::Zero();    ///< width and height [px]
  std::string heading;                               ///< text above it
  FigureAxis x;                                      ///< the horizontal axis
  FigureAxis y;                                      ///< the vertical axis
  std::vector<FigureShape> shapes;                   ///< what it shows
  /// Texts beside points where there is room, the first ones first.
  std::vector<FigureText> labels;
  std::optional<FigureScale> scale;  ///< the bar of colours at its right
  bool grid = true;                  ///< whether lines cross it at the numbers of its axes
  bool equal = false;                ///< whether both axes have one scale: make_equal()
};

/// Where a legend stands.
enum class LegendPlace {
  kTop,     ///< above the panels
  kBottom,  ///< below them
  kNone     ///< nowhere
};

/// A title, notes, a legend, and an area with panels.
struct Figure {
  std::string title;                             ///< first line
  std::vector<std::string> notes;                ///< lines below the title
  std::vector<LegendEntry> legend;               ///< what the marks mean
  double width_px = 0;                           ///< width of the area
  double height_px = 0;                          ///< height of the area
  std::vector<FigurePanel> panels;               ///< in the area
  LegendPlace legend_place = LegendPlace::kTop;  ///< where the legend stands
  double scale = 1;  ///< pixels of the picture for each of the lengths above, texts and strokes too
};

/// Makes the scale of both axes equal by widening the range of one, and marks the panel so.
void make_equal(FigurePanel& panel);

/// The picture as SVG text. It is as wide as the area, and higher by title, notes and legend.
/// The text does not grow with the numbers of points: where its lines would take more than 170 kB,
/// or its dots more than 60 kB, they are thinned, to within half a pixel if that is enough. Gaps
/// and single points that lie off their neighbours stay. A note names a tolerance that is seen.
/// `detail`: share of these bytes, above 0, for a picture that is one of several.
std::string to_svg(const Figure& figure, double detail = 1);

}  // namespace placegraph
