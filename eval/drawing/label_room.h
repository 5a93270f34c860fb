#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace placegraph {

/// The room of a panel that labels may use. Coordinates in pixels, y down; cells of 3 px.
class LabelRoom {
 public:
  LabelRoom(const Eigen::Vector2d& corner, const Eigen::Vector2d& size);

  /// No label may cover this box or line.
  void occupy(const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
  void occupy_line(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

  /// Finds a free box of this size beside a point and occupies it.
  /// Returns its top left corner; nothing if each of the eight boxes around the point is occupied
  /// or leaves the panel.
  std::optional<Eigen::Vector2d> place_beside(const Eigen::Vector2d& point,
                                              const Eigen::Vector2d& size);

 private:
  /// First and last cell of an interval along an axis, within the panel.
  std::pair<int, int> cells(int axis, double from, double to) const;
  bool is_free(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) const;

  Eigen::Vector2d corner_, size_;
  int columns_ = 0, rows_ = 0;
  std::vector<char> occupied_;  ///< columns_ x rows_, row by row
};

}  // namespace placegraph
