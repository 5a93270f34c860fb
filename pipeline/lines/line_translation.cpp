#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/pipeline/lines/line_translation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

/// The plane of a line along d, and the accuracy of its rotation.
struct PlaneAlong {
  Eigen::Vector3d n;  ///< unit vector, perpendicular to d
  double reach;       ///< sine of the angle from d to the outer end of the visible part
  double sigma_rad;   ///< standard deviation of a rotation about d
};

std::optional<PlaneAlong> plane_along(const Camera& camera, const ImageLine::Carriers& seen,
                                      const Eigen::Vector3d& d_cam) {
  constexpr double kPasses = 0.99;  // minimum for a line along d
  const Eigen::Vector3d n = plane_normal(camera, seen.first, seen.second);
  const Eigen::Vector3d across = n - n.dot(d_cam) * d_cam;
  if (!(across.norm() > kPasses)) return std::nullopt;
  double reach = 0;
  for (const Eigen::Vector2d& px : {seen.first, seen.second}) {
    const Eigen::Vector3d ray((px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy,
                              1);
    reach = std::max(reach, ray.normalized().cross(d_cam).norm());
  }
  if (!(reach > 0)) return std::nullopt;
  return PlaneAlong{across.normalized(), reach,
                    seen.sigma_px / (std::min(camera.fx, camera.fy) * reach)};
}

}  // namespace

/// With t the translation in the earlier keyframe, n the plane's normal there and r the line's
/// perpendicular distance, n^T t = r sin(angle). r is known to a factor only, so that the angle
/// itself is used as the standard deviation.
std::vector<MotionObservation> translation_along_lines(
    const SlidingWindow& window, const Camera& camera,
    const std::vector<VanishingDirectionTracker::DirectionCluster>& clusters,
    const LineObservations& observations, KeyframeId keyframe, double depth,
    double max_rotation_rad) {
  constexpr std::size_t kBack = 5;  // number of earlier keyframes used
  // Cosine to the translation: other lines are triangulated, or far away.
  constexpr double kAlong = 0.96;
  constexpr double kRollSigmaRad = 1e-3;  // roll between two keyframes
  constexpr double kFactor = 2;           // uncertainty of the distance
  const auto keyframes = window.keyframes();
  const KeyframeId oldest = keyframes[keyframes.size() - std::min(keyframes.size(), kBack + 1)];
  const SE3 T_odom_to = window.pose(keyframe);
  std::vector<MotionObservation> motions;
  for (const auto& cluster : clusters) {
    // Constraint by the earlier keyframe, in its frame.
    std::map<KeyframeId, Eigen::Matrix3d> constraints;
    for (const LineId id : cluster.tracks) {
      const auto track = observations.find(id);
      if (track == observations.end() || window.line(id)) continue;
      const LineInKeyframe& now = track->second.back();
      const auto then = std::find_if(track->second.begin(), track->second.end(),
                                     [&](const LineInKeyframe& s) { return s.keyframe >= oldest; });
      if (now.keyframe != keyframe || then->keyframe == keyframe) continue;
      const SE3 T_odom_from = window.pose(then->keyframe);
      const SE3 T_from_to = T_odom_from.inverse() * T_odom_to;
      const Eigen::Vector3d d_from = T_odom_from.rotation().inverse() * cluster.d_ref;
      if (!(std::abs(d_from.dot(T_from_to.translation())) >
            kAlong * T_from_to.translation().norm()))
        continue;
      const auto a = plane_along(camera, then->seen, d_from);
      const auto b = plane_along(camera, now.seen, T_from_to.rotation().inverse() * d_from);
      if (!a || !b) continue;
      const double rotation_rad =
          std::asin(std::min(1.0, a->n.cross(T_from_to.rotation() * b->n).norm()));
      if (rotation_rad > max_rotation_rad) continue;
      const double sigma =
          kFactor * depth * b->reach *
          std::hypot(rotation_rad, std::hypot(a->sigma_rad, b->sigma_rad), kRollSigmaRad);
      constraints.try_emplace(then->keyframe, Eigen::Matrix3d::Zero()).first->second +=
          a->n * a->n.transpose() / (sigma * sigma);
    }
    for (const auto& [from, across] : constraints) {
      const SE3 T_odom_from = window.pose(from);
      const SE3 T_from_to = T_odom_from.inverse() * T_odom_to;
      const Eigen::Vector3d d_from = T_odom_from.rotation().inverse() * cluster.d_ref;
      MotionObservation motion{
          from, keyframe, SE3(T_from_to.rotation(), d_from * d_from.dot(T_from_to.translation())),
          Matrix6d::Zero()};
      const Eigen::Matrix3d R = T_from_to.rotation().matrix();
      const Eigen::Matrix3d seen = R.transpose() * across * R;
      motion.information.topLeftCorner<3, 3>() = 0.5 * (seen + seen.transpose());
      motions.push_back(motion);
    }
  }
  return motions;
}

}  // namespace placegraph
