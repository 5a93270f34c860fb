#include <placegraph/eval/drawing/label_room.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr double kCell_px = 3;
constexpr double kGap_px = 5;  ///< between a point and its label

}  // namespace

LabelRoom::LabelRoom(const Vector2d& corner, const Vector2d& size)
    : corner_(corner),
      size_(size),
      columns_(static_cast<int>(std::ceil(size[0] / kCell_px))),
      rows_(static_cast<int>(std::ceil(size[1] / kCell_px))),
      occupied_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

std::pair<int, int> LabelRoom::cells(int axis, double from, double to) const {
  const auto cell = [&](double at) {
    const double last = (axis == 0 ? columns_ : rows_) - 1;
    return static_cast<int>(std::clamp(std::floor((at - corner_[axis]) / kCell_px), 0.0, last));
  };
  return {cell(from), cell(to)};
}

void LabelRoom::occupy(const Vector2d& corner, const Vector2d& size) {
  const Vector2d end = corner + size;
  if ((end.array() < corner_.array()).any() || (corner.array() > (corner_ + size_).array()).any())
    return;
  const auto [left, right] = cells(0, corner[0], end[0]);
  const auto [top, bottom] = cells(1, corner[1], end[1]);
  for (int y = top; y <= bottom; ++y)
    std::fill(occupied_.begin() + y * columns_ + left, occupied_.begin() + y * columns_ + right + 1,
              char{1});
}

void LabelRoom::occupy_line(const Vector2d& a, const Vector2d& b) {
  constexpr double kMostSteps = 4096;  // a line that leaves the panel by far
  const double steps = std::min(kMostSteps, std::ceil((b - a).norm() / kCell_px) + 1);
  for (double i = 0; i <= steps; ++i) occupy(a + i / steps * (b - a), Vector2d::Zero());
}

bool LabelRoom::is_free(const Vector2d& corner, const Vector2d& size) const {
  const Vector2d end = corner + size;
  if ((corner.array() < corner_.array()).any() || (end.array() > (corner_ + size_).array()).any())
    return false;
  const auto [left, right] = cells(0, corner[0], end[0]);
  const auto [top, bottom] = cells(1, corner[1], end[1]);
  for (int y = top; y <= bottom; ++y)
    if (std::any_of(occupied_.begin() + y * columns_ + left,
                    occupied_.begin() + y * columns_ + right + 1, [](char taken) { return taken; }))
      return false;
  return true;
}

std::optional<Vector2d> LabelRoom::place_beside(const Vector2d& point, const Vector2d& size) {
  for (const auto& [x, y] :
       {std::pair(1, -1), {1, 1}, {-1, -1}, {-1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}}) {
    // The label's middle lies off the point in the direction (x, y).
    const Vector2d off = 0.5 * size + Vector2d(kGap_px, kGap_px);
    const Vector2d corner = point + Vector2d(x * off[0], y * off[1]) - 0.5 * size;
    if (!is_free(corner, size)) continue;
    occupy(corner, size);
    return corner;
  }
  return std::nullopt;
}

}  // namespace placegraph
