#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace placegraph {

struct Colour {
  int red = 0, green = 0, blue = 0;
};

enum class TextAnchor { kLeft, kMiddle, kRight };

/// Target of drawing: the same strokes as SVG or as pixels. Coordinates in pixels, y down.
class PlotCanvas {
 public:
  virtual ~PlotCanvas() = default;
  virtual void line(const std::vector<Eigen::Vector2d>& points, Colour colour, double width_px) = 0;
  virtual void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, Colour fill,
                         Colour stroke) = 0;
  virtual void disc(const Eigen::Vector2d& centre, double radius_px, Colour fill,
                    Colour stroke) = 0;
  /// `at` is on the baseline; `size_px` is the height of the font.
  virtual void text(const Eigen::Vector2d& at, const std::string& text, double size_px,
                    Colour colour, TextAnchor anchor) = 0;
  /// Strokes between these two calls are clipped to the rectangle.
  virtual void begin_clip(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) = 0;
  virtual void end_clip() = 0;
  /// Approximate width of a text [px].
  virtual double text_width(const std::string& text, double size_px) const = 0;
  /// The whole picture as file content.
  virtual std::string encode() = 0;
};

std::unique_ptr<PlotCanvas> svg_canvas(int width_px, int height_px);
std::unique_ptr<PlotCanvas> png_canvas(int width_px, int height_px);

}  // namespace placegraph
