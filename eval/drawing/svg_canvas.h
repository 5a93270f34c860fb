#pragma once
#include <placegraph/eval/drawing/figure.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

enum class TextAnchor { kLeft, kMiddle, kRight };

/// The data of a path along lines, in tenths of a pixel; each point relative to the one before it.
/// Points that are not finite are left out.
std::string path_in_tenths(const std::vector<std::vector<Eigen::Vector2d>>& lines);

/// A picture in SVG, of which the strokes lie above each other in the order of the calls.
/// Coordinates in pixels, y down; the ground is white. Points that are not finite are left out.
class SvgCanvas {
 public:
  /// `scale`: pixels of the picture for each of the lengths that the calls name.
  SvgCanvas(double width_px, double height_px, double scale = 1);
  void line(const std::vector<Eigen::Vector2d>& points, const Stroke& stroke);
  /// Several lines in one stroke, which is nowhere less transparent where they overlap, in
  /// coordinates that take few bytes.
  void lines(const std::vector<std::vector<Eigen::Vector2d>>& lines, const Stroke& stroke);
  /// Fills rings; what lies in a ring within another one is a hole.
  void area(const std::vector<std::vector<Eigen::Vector2d>>& rings, Colour fill, double opacity);
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, Colour fill,
                 Colour edge);
  void disc(const Eigen::Vector2d& centre, double radius_px, Colour fill, Colour edge,
            double edge_px = 2);
  /// Discs that differ by their centres alone.
  void discs(const std::vector<Eigen::Vector2d>& centres, double radius_px, Colour fill,
             Colour edge, double edge_px);
  /// `at` is on the baseline; `size_px` is the height of the font. A rotated text reads upwards.
  void text(const Eigen::Vector2d& at, const std::string& text, double size_px, Colour colour,
            TextAnchor anchor, bool rotated = false);
  /// A picture of `pixels` columns and rows: its outer corner, and the steps to the pixel at the
  /// right and to the one below. `source` is a data URI.
  void picture(const std::string& source, const Eigen::Vector2d& pixels,
               const Eigen::Vector2d& corner, const Eigen::Vector2d& right,
               const Eigen::Vector2d& down, double opacity);
  /// Strokes between these two calls are clipped to the rectangle.
  void begin_clip(const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
  void end_clip();
  /// The whole document.
  std::string finish() const;

 private:
  std::string out_;
};

}  // namespace placegraph
