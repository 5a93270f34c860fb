#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// A mapped line and its present observation.
struct PlacedLine {
  LineId id;
  Line3 line_ref;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< in the line's tangent space
  LineSegment seen;                                      ///< visible part in the image
};

/// A direction of the scene from another source, such as a vanishing point.
struct SharedDirection {
  Eigen::Vector3d d_ref;  ///< unit vector
  double sigma_rad = 0;
};

/// The floor plane relative to the camera.
struct FloorFromLines {
  Outcome outcome;
  Eigen::Vector3d down_ref = Eigen::Vector3d::UnitY();  ///< unit normal, away from the camera
  double height = 0;  ///< height of the camera's centre above the floor
  double sigma_height = 0;
  std::vector<LineId> on_floor;  ///< lines on the floor or ending there, ascending
};

/// Estimates the floor under a camera from lines of a scene of any scale.
///
/// Vertical lines (lines near the camera's y axis that are parallel to each other) and horizontal
/// lines at right angles to them determine the vertical. Every horizontal line has a height, and so
/// has the lower end of every vertical line. The floor is the lowest level below the camera that is
/// supported by enough of them: ceilings are above the camera, tables and the upper edge of a
/// skirting higher than the floor. Then plane and vertical are fitted together and robustly to the
/// lines on the floor and to the vertical lines, each with its own standard deviation. A direction
/// shared by many lines replaces those lines, whose errors are correlated by the error of the path
/// that they were triangulated from. Outcomes: too few data (neither a vertical line nor two
/// horizontal directions), no consensus (no level has `min_lines`).
[[nodiscard]] FloorFromLines floor_from_lines(const Camera& camera, const SE3& T_ref_cam,
                                              const std::vector<PlacedLine>& lines,
                                              const FloorFromLinesOptions& options,
                                              const std::vector<SharedDirection>& shared = {});

}  // namespace placegraph
