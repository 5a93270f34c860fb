#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Point matches of two views as `xA yA xB yB` lines [px].
/// Further columns, blank lines and lines that begin with `#` are not read.
struct MatchFile {
  std::vector<Eigen::Vector2d> px_a, px_b;  ///< in the first and the second image [px]
};

/// Reads matches of pixels.
/// Throws FileError with the line: fewer columns, a field that is not a finite number, pixels and
/// lengths beyond 1e6; without a line, if there is no match.
MatchFile read_matches(const std::string& path);

/// The same points in two frames, as `xA yA zA xB yB zB` lines [m].
struct PointPairFile {
  std::vector<Eigen::Vector3d> points_a, points_b;
};

/// Points [m] with their pixels, as `X Y Z x y` lines.
struct SeenPointFile {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
};
/// Reads the same points in two frames, as read_matches() does.
PointPairFile read_point_pairs(const std::string& path);
/// Reads points with their pixels, as read_matches() does.
SeenPointFile read_seen_points(const std::string& path);

}  // namespace placegraph::apps
