#pragma once
#include <placegraph/eval/drawing/line_thinning.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// The cells of an area that lines cross. Coordinates in pixels.
class CoveredCells {
 public:
  /// A segment that is near covered cells is at no point farther than the distance from a line that
  /// covers them.
  CoveredCells(const PixelArea& area, double distance_px);

  /// Covers the cells of a segment, unless each of them is covered or beside a covered one.
  /// What lies outside the area needs no cover. Returns whether it covers them.
  bool cover(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

 private:
  /// Calls `visit` with column and row of the cells of a segment in their order, while it is true.
  template <typename Visit>
  bool for_cells(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Visit& visit) const;
  void cover_cell(int column, int row);
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  PixelArea area_;
  double cell_px_;
  int columns_, rows_;
  std::vector<bool> covered_,
      near_;  ///< columns_ x rows_, row by row; near_: or beside a covered one
};

}  // namespace placegraph
