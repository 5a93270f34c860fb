#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/frontend/markers/square_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/marker_layout.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace placegraph {
namespace {

using Code = Outcome::Code;

/// Whether the corners are a convex quadrangle, clockwise in the image: a marker seen from its
/// face.
bool faces_camera(const SquareCorners& corners) {
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d a = corners[(k + 1) % 4] - corners[k];
    const Eigen::Vector2d b = corners[(k + 2) % 4] - corners[(k + 1) % 4];
    if (!(a.x() * b.y() - a.y() * b.x() > 1e-6 * a.norm() * b.norm())) return false;
  }
  return true;
}

/// The two poses in closed form from the rays of the corners.
std::vector<SE3> ippe_square(const SquareCorners& corners_px, double side_m, const Camera& camera) {
  std::vector<cv::Point2d> rays;
  for (const Eigen::Vector2d& px : corners_px) {
    const auto ray = camera.unproject(px);
    if (!ray) return {};
    rays.emplace_back(ray->x(), ray->y());
  }
  std::vector<cv::Point3d> points;
  PlacedMarker marker;
  marker.side_m = side_m;
  for (const Eigen::Vector3d& p : marker.corners_marker()) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<cv::Vec3d> rvecs, tvecs;
  cv::solvePnPGeneric(points, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rvecs, tvecs, false,
                      cv::SOLVEPNP_IPPE_SQUARE);
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < rvecs.size(); ++i) {
    const Eigen::Vector3d w(rvecs[i][0], rvecs[i][1], rvecs[i][2]);
    const Eigen::Vector3d t(tvecs[i][0], tvecs[i][1], tvecs[i][2]);
    if (w.allFinite() && t.allFinite()) poses.emplace_back(SO3::exp(w), t);
  }
  return poses;
}

/// Whether the camera is on the side to which the marker's z axis points.
bool face_seen(const SE3& T_cam_marker) {
  const Eigen::Vector3d normal = T_cam_marker.rotation() * Eigen::Vector3d::UnitZ();
  return T_cam_marker.translation().z() > 0 && normal.dot(T_cam_marker.translation()) < 0;
}

}  // namespace

double MarkerPoses::margin() const {
  return poses.size() < 2 ? std::numeric_limits<double>::infinity() : poses[1].chi2 - poses[0].chi2;
}

MarkerPoses estimate_marker_poses(const MarkerObservation& observation, double side_m,
                                  const Camera& camera) {
  require(side_m > 0, "estimate_marker_poses: the side of the marker must be positive");
  MarkerPoses result;
  SeenSquare seen;
  seen.corners_px = observation.corners_px;
  PlacedMarker marker;
  marker.side_m = side_m;
  seen.corners_ref = marker.corners_marker();
  const Eigen::LLT<Eigen::Matrix<double, 8, 8>> covariance(observation.covariance);
  const bool finite = std::all_of(seen.corners_px.begin(), seen.corners_px.end(),
                                  [](const Eigen::Vector2d& px) { return px.allFinite(); });
  if (!finite || !observation.covariance.allFinite() || covariance.info() != Eigen::Success ||
      !faces_camera(seen.corners_px)) {
    result.outcome =
        Outcome::failure(Code::kDegenerate, "the corners are not the face of a marker");
    return result;
  }
  seen.information = covariance.solve(Eigen::Matrix<double, 8, 8>::Identity());

  result.outcome = Outcome::failure(Code::kNoConsensus, "no pose has the marker before the camera");
  std::vector<SquarePose> minima;
  const auto take = [&](const SquarePose& refined) {
    if (!refined.outcome) {
      if (result.poses.empty()) result.outcome = refined.outcome;
      return;
    }
    for (const SquarePose& known : minima)
      if (same_minimum(known, refined)) return;
    MarkerPose pose;
    pose.T_cam_marker = refined.T_ref_cam.inverse();
    if (!face_seen(pose.T_cam_marker)) return;
    const Matrix6d rotated = refined.T_ref_cam.adjoint();
    pose.covariance = rotated * refined.covariance * rotated.transpose();
    pose.chi2 = refined.chi2;
    double squared = 0;
    for (int k = 0; k < 4; ++k)
      squared += (*camera.project(pose.T_cam_marker * seen.corners_ref[k]) - seen.corners_px[k])
                     .squaredNorm();
    pose.rms_px = std::sqrt(squared / 4);
    minima.push_back(refined);
    result.poses.push_back(pose);
  };
  for (const SE3& start : ippe_square(seen.corners_px, side_m, camera))
    take(refine_square_pose(camera, {seen}, {}, start.inverse()));
  if (result.poses.size() == 1) {
    const SquarePose rival =
        find_planar_rival(camera, {seen}, {}, result.poses[0].T_cam_marker.inverse(),
                          Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
    if (rival.outcome) take(rival);
  }
  if (result.poses.empty()) return result;
  std::sort(result.poses.begin(), result.poses.end(),
            [](const MarkerPose& a, const MarkerPose& b) { return a.chi2 < b.chi2; });
  result.outcome = Outcome::ok();
  return result;
}

LayoutPose estimate_layout_pose(const Image& grey, const std::vector<MarkerObservation>& markers,
                                const MarkerLayout& layout, const Camera& camera) {
  LayoutPose pose;
  if (layout.markers.empty() && layout.beacons_world.empty()) {
    pose.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                    "the layout has no pose of a marker or beacon");
    return pose;
  }
  MarkerView view;
  view.stamp_ns = 1;
  view.markers = markers;
  if (!layout.beacons_world.empty()) view.beacons = detect_beacons(grey);
  const MarkerPoseEstimate found = MarkerFilter({}, layout, camera, SE3()).observe(view);
  return {found.outcome, found.observation.T_world_body, found.observation.covariance,
          found.markers, found.beacons};
}

}  // namespace placegraph
