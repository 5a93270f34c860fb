#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

/// Point matches of two views as `xA yA xB yB` lines [px]; what follows on a line is not read, nor
/// are blank lines and those that begin with `#`.
struct MatchFile {
  std::vector<Eigen::Vector2d> px_a, px_b;
};

/// Throws FileError with the line: fewer columns, what is no finite number, pixels and lengths
/// beyond 1e6; without one, no match at all.
MatchFile read_matches(const std::string& path);

/// The same points in two frames, as `xA yA zA xB yB zB` lines [m], and points with their pixels,
/// as `X Y Z x y`; else the same.
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
