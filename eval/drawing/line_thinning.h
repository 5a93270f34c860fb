#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace placegraph {

/// A line in a picture, with gaps at missing points. Coordinates in pixels.
struct PixelLine {
  std::vector<std::optional<Eigen::Vector2d>> points;  ///< nothing, or not finite: a gap
  std::vector<int> levels;  ///< of colour, not negative, at each point; empty: all 0
};

/// What is left of the parts of a line that have one level of colour.
struct ThinnedLine {
  int level = 0;
  std::vector<std::vector<Eigen::Vector2d>> stretches;  ///< each of two points or more [px]
};

/// A rectangle of a picture [px].
struct PixelArea {
  Eigen::Vector2d corner, size;
};

/// Thins a line so that no dropped point is farther than the tolerance from what is drawn.
///
/// Of what falls together, the highest level is kept; levels ascend in the result, points and
/// stretches of a level are in the order of the line. Gaps stay gaps. What lies outside the area
/// is left out. A line without levels that is a function of x keeps the least and the greatest
/// value of every column. The time is linear in the number of points, and in the number of cells
/// of `tolerance_px` / 5 that the stretches cross.
///
/// Without a tolerance it throws ArgumentError. Nothing is returned if more than `most_points`
/// would be left.
std::optional<std::vector<ThinnedLine>> thin_line(
    const PixelLine& line, double tolerance_px, const PixelArea& area,
    std::size_t most_points = std::numeric_limits<std::size_t>::max());

/// Points of which no other one is in the same cell; the first one of a cell is kept.
/// No dropped point is farther than the tolerance from one that is kept. Points that are not
/// finite are dropped.
std::vector<Eigen::Vector2d> thin_points(const std::vector<Eigen::Vector2d>& points_px,
                                         double tolerance_px);

}  // namespace placegraph
