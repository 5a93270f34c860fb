#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

/// Point matches of two views as `xA yA xB yB` lines [px]; further columns, blank lines and lines
/// that begin with `#` are not read.
struct MatchFile {
  std::vector<Eigen::Vector2d> px_a, px_b;
};

/// Throws FileError with the line: fewer columns, a field that is not a finite number, pixels and
/// lengths beyond 1e6; without a line, if there is no match.
MatchFile read_matches(const std::string& path);

/// The same points in two frames, as `xA yA zA xB yB zB` lines [m], and points with their pixels,
/// as `X Y Z x y`; otherwise as above.
struct PointPairFile {
  std::vector<Eigen::Vector3d> points_a, points_b;
};
struct SeenPointFile {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
};
PointPairFile read_point_pairs(const std::string& path);
SeenPointFile read_seen_points(const std::string& path);

}  // namespace placegraph
