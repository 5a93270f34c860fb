#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace placegraph {

/// A line of the scene as one eye sees it.
struct LineMeasurement {
  SE3 T_ref_cam;
  ImageLine::Carriers seen;  ///< two points of the image line [px], independent
};

struct TriangulatedLine {
  Outcome outcome;
  Line3 line_ref;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< in the line's tangent
  double rotation_rad = 0;  ///< between the planes of the two sightings that turn most
  double error_sigmas = 0;  ///< of the worst sighting
};

/// The line that all sightings see: planes of the two sightings that turn most meet in it, then
/// Gauss-Newton over all on the distances of the carriers from the projected line. With two
/// sightings there is no redundancy, and the line says nothing of their poses. Outcomes: too few
/// data (fewer than two), degenerate (the planes turn too little: the line runs along the epipolar
/// planes, or the eyes did not move across it), inconsistent (a sighting misses, or the line lies
/// behind an eye that sees it).
[[nodiscard]] TriangulatedLine triangulate_line(const Camera& camera,
                                                const std::vector<LineMeasurement>& observations,
                                                const LineTriangulationOptions& options);

/// Unit normal, in the camera, of the plane through its centre and an image line.
Eigen::Vector3d plane_normal(const Camera& camera, const Eigen::Vector2d& px_a,
                             const Eigen::Vector2d& px_b);

/// Distances of two pixels from the projection of a line [px], signed, with derivatives by
/// T_ref_cam
/// [+] xi and by the line's tangent; nothing if the line has no image.
std::optional<Eigen::Vector2d> line_residual_px(const Camera& camera, const SE3& T_ref_cam,
                                                const Line3& line_ref, const Eigen::Vector2d& px_a,
                                                const Eigen::Vector2d& px_b,
                                                Eigen::Matrix<double, 2, 6>* J_pose = nullptr,
                                                Eigen::Matrix<double, 2, 4>* J_line = nullptr);

/// z of the point of the line next to the viewing ray of a pixel; nothing where both are parallel.
std::optional<double> depth_on_line(const Camera& camera, const SE3& T_ref_cam,
                                    const Line3& line_ref, const Eigen::Vector2d& px);

}  // namespace placegraph
