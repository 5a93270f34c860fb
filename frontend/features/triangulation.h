#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

/// An observation of a point: the camera's pose in the reference frame and the pixel.
struct PointMeasurement {
  SE3 T_ref_cam;
  Eigen::Vector2d px;
};

/// A triangulated point.
struct TriangulationResult {
  Outcome outcome;
  Eigen::Vector3d point_ref = Eigen::Vector3d::Zero();  ///< meaningful only if outcome
  double parallax_rad = 0;                              ///< greatest angle between two viewing rays
  double max_error_px = 0;                              ///< greatest reprojection error
};

/// Triangulates a point from observations at two or more poses.
///
/// Linear in homogeneous coordinates (Hartley & Zisserman 2004, 12.2), then Gauss-Newton on the
/// reprojection errors. Outcomes: too few data (< 2), degenerate (parallax below
/// `min_parallax_rad`, or behind a camera), inconsistent (an error above `max_error_px`).
[[nodiscard]] TriangulationResult triangulate(const Camera& camera,
                                              const std::vector<PointMeasurement>& observations,
                                              double min_parallax_rad, double max_error_px);

}  // namespace placegraph
