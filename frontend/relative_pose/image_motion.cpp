#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/image_motion.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
std::optional<ImageMotion> ImageMotion::estimate(const Camera& camera,
                                                 const std::vector<Eigen::Vector2d>& px_ref,
                                                 const std::vector<Eigen::Vector2d>& px_cur,
                                                 Random& random) {
  // Share of inliers of a motion that is accepted. Chosen: a clear majority.
  constexpr double kLeastShare = 0.6;
  const RelativePose pose =
      estimate_relative_pose(camera, px_ref, px_cur, RelativePoseOptions(), random);
  if (!pose.outcome && pose.rivals.empty()) return std::nullopt;
  if (static_cast<double>(pose.inliers.size()) < kLeastShare * static_cast<double>(px_ref.size()))
    return std::nullopt;
  return ImageMotion(camera, pose);
}

std::optional<ImageMotion::Displacement> ImageMotion::least_displacement(
    const Eigen::Vector2d& px) const {
  const auto ray = camera_.unproject(px);
  if (!ray) return std::nullopt;
  if (pose_.model == RelativePoseModel::kRotation) return by_rotation(*ray, px);
  std::optional<Displacement> least = by_epipolar_line(*pose_.T_ref_cur, *ray);
  for (const SE3& rival : pose_.rivals) {
    const auto other = by_epipolar_line(rival, *ray);
    if (!least || !other) return std::nullopt;
    if (other->px.norm() < least->px.norm()) least = other;
  }
  return least;
}

std::optional<ImageMotion::Displacement> ImageMotion::by_rotation(const Eigen::Vector3d& ray,
                                                                  const Eigen::Vector2d& px) const {
  const auto rotated = camera_.project(pose_.R_ref_cur->inverse() * ray);
  if (!rotated) return std::nullopt;
  const double variance = pose_.covariance.bottomRightCorner<3, 3>().trace();
  return Displacement{*rotated - px, camera_.fx * std::sqrt(variance)};
}

/// To the epipolar line in the second image. The Sampson error is the distance if both pixels may
/// move; only the second one does.
std::optional<ImageMotion::Displacement> ImageMotion::by_epipolar_line(
    const SE3& T_ref_cur, const Eigen::Vector3d& ray) const {
  Eigen::Matrix<double, 1, 6> J;
  const double sampson_px = EpipolarError(camera_, T_ref_cur)(ray, ray, &J);
  const Eigen::Matrix3d E = hat(T_ref_cur.translation()) * T_ref_cur.rotation().matrix();
  const Eigen::Vector2d normal = (E.transpose() * ray).head<2>().normalized();
  if (!std::isfinite(sampson_px) || !J.allFinite() || !normal.allFinite()) return std::nullopt;
  const double sigma_px = std::sqrt(std::max(0.0, (J * pose_.covariance * J.transpose()).value()));
  return Displacement{-std::sqrt(2.0) * sampson_px * normal, std::sqrt(2.0) * sigma_px};
}

}  // namespace placegraph
