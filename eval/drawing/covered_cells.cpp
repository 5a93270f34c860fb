#include <placegraph/eval/drawing/covered_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace placegraph {
namespace {

using Eigen::Vector2d;

/// The first and the last share of a segment within the area; the first is greater if none is.
std::pair<double, double> shares_within(const PixelArea& area, const Vector2d& a,
                                        const Vector2d& b) {
  double first = 0, last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = b[axis] - a[axis], low = area.corner[axis] - a[axis],
                 high = low + area.size[axis];
    if (along == 0) {
      if (low > 0 || high < 0) return {1, 0};
      continue;
    }
    first = std::max(first, std::min(low / along, high / along));
    last = std::min(last, std::max(low / along, high / along));
  }
  return {first, last};
}

}  // namespace

CoveredCells::CoveredCells(const PixelArea& area, double distance_px)
    : area_(area),
      cell_px_(distance_px / (2 * std::numbers::sqrt2)),  // the diagonal of two cells by two
      columns_(static_cast<int>(std::ceil(area.size[0] / cell_px_)) + 1),
      rows_(static_cast<int>(std::ceil(area.size[1] / cell_px_)) + 1),
      covered_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
      near_(covered_.size()) {}

template <typename Visit>
bool CoveredCells::for_cells(const Vector2d& a, const Vector2d& b, const Visit& visit) const {
  const auto [first, last] = shares_within(area_, a, b);
  if (first > last) return true;
  const int most[] = {columns_ - 1, rows_ - 1};
  int cell[2], end[2], step[2];
  double next[2], stride[2];  // shares of the segment where it enters another column or row
  for (int axis = 0; axis < 2; ++axis) {
    const double from = (a[axis] - area_.corner[axis]) / cell_px_,
                 rate = (b[axis] - a[axis]) / cell_px_;
    const auto cell_at = [&](double share) {
      return static_cast<int>(
          std::clamp(std::floor(from + share * rate), 0.0, static_cast<double>(most[axis])));
    };
    cell[axis] = cell_at(first);
    end[axis] = cell_at(last);
    step[axis] = end[axis] > cell[axis] ? 1 : -1;
    const bool crosses = end[axis] != cell[axis];
    stride[axis] = crosses ? std::abs(1 / rate) : std::numeric_limits<double>::infinity();
    next[axis] = crosses ? (cell[axis] + (step[axis] > 0 ? 1 : 0) - from) / rate : stride[axis];
  }
  if (!visit(cell[0], cell[1])) return false;
  while (cell[0] != end[0] || cell[1] != end[1]) {
    const int axis = cell[0] == end[0] || (cell[1] != end[1] && next[1] < next[0]) ? 1 : 0;
    cell[axis] += step[axis];
    next[axis] += stride[axis];
    if (!visit(cell[0], cell[1])) return false;
  }
  return true;
}

void CoveredCells::cover_cell(int column, int row) {
  if (covered_[index(column, row)]) return;
  covered_[index(column, row)] = true;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows_ - 1); ++y)
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, columns_ - 1); ++x)
      near_[index(x, y)] = true;
}

bool CoveredCells::cover(const Vector2d& a, const Vector2d& b) {
  if (for_cells(a, b, [this](int column, int row) { return bool(near_[index(column, row)]); }))
    return false;
  for_cells(a, b, [this](int column, int row) {
    cover_cell(column, row);
    return true;
  });
  return true;
}

}  // namespace placegraph
