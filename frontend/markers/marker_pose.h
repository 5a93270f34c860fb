#pragma once
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/marker_layout.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One of the poses that explain a marker's four corners.
struct MarkerPose {
  SE3 T_cam_marker;                        ///< in the frame of PlacedMarker
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent of T_cam_marker
  double chi2 = 0;    ///< squared error of the corners in their covariance (2 dof)
  double rms_px = 0;  ///< root mean square of the corners' distances
};

/// Both poses of a marker.
struct MarkerPoses {
  Outcome outcome;                ///< see estimate_marker_poses
  std::vector<MarkerPose> poses;  ///< one or two, the better explanation first
  /// chi2 of the second pose minus that of the first; infinite if there is only one.
  double margin() const;
};

/// Estimates both poses of a square marker.
///
/// The image of a distant planar square is nearly the same when its tilt towards the camera is
/// mirrored, and the squared error has a minimum at both poses (Collins & Bartoli 2014,
/// "Infinitesimal plane-based pose estimation", by OpenCV). Each is refined on the corners in the
/// covariance C of the observation; its covariance is (J^T C^-1 J)^-1. If noise leaves only one
/// minimum, the other pose is the mirrored one (find_planar_rival). Outcomes: degenerate (the
/// corners are not a convex quadrangle, or leave a direction undetermined), no consensus (no pose
/// has the marker in front of the camera with its face towards it).
[[nodiscard]] MarkerPoses estimate_marker_poses(const MarkerObservation& observation, double side_m,
                                                const Camera& camera);

/// Pose of a camera in a layout of markers.
struct LayoutPose {
  /// Outcomes: too few data (nothing known in view, or no pose is known), inconsistent (two poses
  /// are still possible, or the markers contradict all), degenerate.
  Outcome outcome;
  SE3 T_world_cam;                         ///< meaningful only if outcome
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent of T_world_cam
  int markers = 0;                         ///< number of markers used
  int beacons = 0;                         ///< number of beacons used
};

/// Estimates the pose of a camera from the markers and beacons of one image.
///
/// `grey`: CV_8UC1, in which the beacons of the layout are detected; `markers`: those that
/// MarkerDetector found in it. Throws ArgumentError for an invalid camera.
[[nodiscard]] LayoutPose estimate_layout_pose(const Image& grey,
                                              const std::vector<MarkerObservation>& markers,
                                              const MarkerLayout& layout, const Camera& camera);

}  // namespace placegraph
