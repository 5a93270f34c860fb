#include <placegraph/frontend/features/triangulation.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

/// The largest angle between two of the rays, which have unit length [rad].
double largest_angle(const std::vector<Eigen::Vector3d>& rays) {
  double largest = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t j = i + 1; j < rays.size(); ++j)
      largest = std::max(largest, std::atan2(rays[i].cross(rays[j]).norm(), rays[i].dot(rays[j])));
  return largest;
}

/// The point of least reprojection errors, by Gauss-Newton from a point near it; nothing if it
/// moves behind a camera.
std::optional<Eigen::Vector3d> least_reprojection_errors(
    const Camera& camera, const std::vector<PointMeasurement>& observations,
    const std::vector<SE3>& T_cam_ref, Eigen::Vector3d p) {
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      Eigen::Matrix<double, 2, 3> J_px_cam;
      const auto px = camera.project(T_cam_ref[i] * p, &J_px_cam);
      if (!px) return std::nullopt;
      const Eigen::Matrix<double, 2, 3> J = J_px_cam * T_cam_ref[i].rotation().matrix();
      H.noalias() += J.transpose() * J;
      g.noalias() += J.transpose() * (*px - observations[i].px);
    }
    const Eigen::Vector3d step =
        -(H + 1e-12 * H.trace() * Eigen::Matrix3d::Identity()).ldlt().solve(g);
    if (!step.allFinite()) break;
    p += step;
    if (step.norm() < 1e-6 * p.norm()) break;
  }
  return p;
}

}  // namespace

TriangulationResult triangulate(const Camera& camera,
                                const std::vector<PointMeasurement>& observations,
                                double min_parallax_rad, double max_error_px) {
  using Code = Outcome::Code;
  TriangulationResult result;
  if (observations.size() < 2) {
    result.outcome = Outcome::failure(Code::kTooFewData, "two observations needed");
    return result;
  }
  std::vector<SE3> T_cam_ref;
  std::vector<Eigen::Vector3d> rays_ref;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (const PointMeasurement& s : observations) {
    T_cam_ref.push_back(s.T_ref_cam.inverse());
    const auto ray = camera.unproject(s.px);
    if (!ray) {
      result.outcome = Outcome::failure(Code::kDegenerate, "pixel without viewing ray");
      return result;
    }
    rays_ref.push_back((s.T_ref_cam.rotation() * *ray).normalized());
    const Eigen::Matrix4d P = T_cam_ref.back().matrix();
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::RowVector4d row = (*ray)[axis] * P.row(2) - P.row(axis);
      normal.noalias() += row.transpose() * row;
    }
  }
  result.parallax_rad = largest_angle(rays_ref);
  if (result.parallax_rad < min_parallax_rad) {
    result.outcome = Outcome::failure(Code::kDegenerate, "too little parallax");
    return result;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(normal);
  const Eigen::Vector4d h = eigen.eigenvectors().col(0);
  if (std::abs(h[3]) < 1e-9) {
    result.outcome = Outcome::failure(Code::kDegenerate, "the point lies at infinity");
    return result;
  }
  const auto p = least_reprojection_errors(camera, observations, T_cam_ref,
                                           Eigen::Vector3d(h.head<3>() / h[3]));
  if (!p) {
    result.outcome = Outcome::failure(Code::kDegenerate, "the point lies behind a camera");
    return result;
  }
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const auto px = camera.project(T_cam_ref[i] * *p);
    if (!px) {
      result.outcome = Outcome::failure(Code::kDegenerate, "the point lies behind a camera");
      return result;
    }
    result.max_error_px = std::max(result.max_error_px, (*px - observations[i].px).norm());
  }
  result.point_ref = *p;
  result.outcome = result.max_error_px <= max_error_px
                       ? Outcome::ok()
                       : Outcome::failure(Code::kInconsistent, "reprojection error too large");
  return result;
}

}  // namespace placegraph
