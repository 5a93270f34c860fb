#pragma once
#include <placegraph/frontend/internal/markers/marker_detector.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <vector>

namespace placegraph {

/// One of the poses that explain a marker's four corners.
struct MarkerPose {
  SE3 T_cam_marker;                        ///< the frame of PlacedMarker
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent of T_cam_marker
  double chi2 = 0;                         ///< of the corners, in their covariance (2 dof)
  double rms_px = 0;                       ///< of the corners' distances
};

struct MarkerPoses {
  Outcome outcome;
  std::vector<MarkerPose> poses;  ///< one or two, the better explanation first
  /// chi2 of the second less that of the first; infinite if there is one only.
  double margin() const;
};

/// Both poses of a square marker: a planar square seen from afar looks nearly the same when its
/// tilt towards the camera is mirrored, and the squared error has a minimum at either (Collins &
/// Bartoli 2014, "Infinitesimal plane-based pose estimation", by OpenCV). Each is refined on the
/// corners in the covariance of the sighting; its own is (J^T C^-1 J)^-1. Where noise leaves one
/// minimum only, the other is the mirrored pose (find_planar_rival). Outcomes: degenerate (the
/// corners are no convex quadrangle, or leave a direction open), no consensus (no pose has the
/// marker in front of the camera, its face towards it).
[[nodiscard]] MarkerPoses estimate_marker_poses(const MarkerObservation& observation, double side_m,
                                                const Camera& camera);

}  // namespace placegraph
