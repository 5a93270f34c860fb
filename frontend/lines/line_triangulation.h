#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace placegraph {

/// An observation of a line of the scene by one camera.
struct LineMeasurement {
  SE3 T_ref_cam;
  ImageLine::Carriers seen;  ///< two points of the image line [px], independent
};

/// A triangulated line.
struct TriangulatedLine {
  Outcome outcome;
  Line3 line_ref;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< in the line's tangent space
  double rotation_rad = 0;  ///< largest angle between the planes of two observations
  double error_sigmas = 0;  ///< largest error of an observation
};

/// Triangulates a line from observations of at least two cameras.
///
/// The intersection of the planes of the two observations with the largest angle, then Gauss-Newton
/// over all observations on the distances of the carriers from the projected line. With two
/// observations there is no redundancy, and the line does not constrain their poses. Outcomes: too
/// few data (fewer than two), degenerate (the angle between the planes is too small: the line is in
/// the epipolar planes, or the cameras did not move across it), inconsistent (an observation is an
/// outlier, or the line is behind a camera that observes it).
[[nodiscard]] TriangulatedLine triangulate_line(const Camera& camera,
                                                const std::vector<LineMeasurement>& observations,
                                                const LineTriangulationOptions& options);

/// Unit normal, in the camera, of the plane through its centre and an image line.
Eigen::Vector3d plane_normal(const Camera& camera, const Eigen::Vector2d& px_a,
                             const Eigen::Vector2d& px_b);

/// Signed distances of two pixels from the projection of a line [px].
///
/// With derivatives by xi in T_ref_cam [+] xi and by the line's tangent; nothing if the line has no
/// image.
std::optional<Eigen::Vector2d> line_residual_px(const Camera& camera, const SE3& T_ref_cam,
                                                const Line3& line_ref, const Eigen::Vector2d& px_a,
                                                const Eigen::Vector2d& px_b,
                                                Eigen::Matrix<double, 2, 6>* J_pose = nullptr,
                                                Eigen::Matrix<double, 2, 4>* J_line = nullptr);

/// z of the point of a line next to the viewing ray of a pixel; nothing if both are parallel.
std::optional<double> depth_on_line(const Camera& camera, const SE3& T_ref_cam,
                                    const Line3& line_ref, const Eigen::Vector2d& px);

}  // namespace placegraph
