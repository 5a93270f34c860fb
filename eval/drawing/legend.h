#pragma once
#include <placegraph/eval/drawing/svg_canvas.h>

#include <string>
#include <vector>

namespace placegraph {

/// Entries in columns of equal width, as many as there is room for; longer texts are shortened in
/// their middle. The first column is read first.
class Legend {
 public:
  Legend(std::vector<LegendEntry> entries, double most_width_px);
  double height_px() const;
  /// Draws it below and to the right of this corner; no more than the given width is used.
  void draw(SvgCanvas& canvas, const Eigen::Vector2d& corner) const;

 private:
  std::vector<LegendEntry> entries_;
  std::size_t rows_ = 0;
  std::vector<double> column_px_;  ///< left side of every column
};

}  // namespace placegraph
