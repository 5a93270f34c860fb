#include <placegraph/frontend/planes/inverse_depth_plane.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Dense>
#include <cmath>

namespace placegraph {
namespace {

// Maximum residual of an inlier, in standard deviations.
constexpr double kInlierSigmas = 3;
// Maximum relative standard deviation of the distance of a plane that is used. Chosen.
constexpr double kMaxSigmaDistance = 0.1;

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Pixels = std::vector<MeasuredInverseDepth>;

/// Least squares over g; `information`, if given, receives the normal matrix.
Vector3d fit(const Pixels& pixels, const std::vector<int>& indices, Matrix3d* information) {
  Matrix3d H = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (const int i : indices) {
    const double weight = 1 / (pixels[i].sigma * pixels[i].sigma);
    H.noalias() += weight * pixels[i].ray_cam * pixels[i].ray_cam.transpose();
    b.noalias() += weight * pixels[i].value * pixels[i].ray_cam;
  }
  if (information) *information = H;
  return H.ldlt().solve(b);
}

double squared_sigmas(const MeasuredInverseDepth& pixel, const Vector3d& g) {
  const double e = (g.dot(pixel.ray_cam) - pixel.value) / pixel.sigma;
  return e * e;
}

std::vector<Vector3d> through_three(const Pixels& pixels, const std::vector<int>& sample) {
  Matrix3d rays;
  Vector3d values;
  for (int i = 0; i < 3; ++i) {
    rays.row(i) = pixels[sample[i]].ray_cam;
    values[i] = pixels[sample[i]].value;
  }
  if (!(std::abs(rays.determinant()) > 1e-9)) return {};  // collinear
  return {rays.inverse() * values};
}

}  // namespace

double sigma_normal_rad(const Vector3d& g, const Matrix3d& covariance) {
  const double length = g.norm();
  const Vector3d n = g / length, e1 = n.unitOrthogonal(), e2 = n.cross(e1);
  Eigen::Matrix<double, 2, 3> across;
  across << e1.transpose(), e2.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(
      Eigen::Matrix2d(across * covariance * across.transpose()), Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[1])) / length;
}

double sigma_log_distance(const Vector3d& g, const Matrix3d& covariance) {
  const Vector3d n = g.normalized();
  return std::sqrt(std::max(0.0, n.dot(covariance * n))) / g.norm();
}

InverseDepthPlane fit_inverse_depth_plane(const Pixels& pixels,
                                          const InverseDepthPlaneOptions& options, Random& random) {
  options.check();
  const auto consensus = ransac<Vector3d>(
      static_cast<int>(pixels.size()), 3, kInlierSigmas * kInlierSigmas, options.ransac, random,
      [&](const std::vector<int>& sample) { return through_three(pixels, sample); },
      [&](const Vector3d& g, int i) { return squared_sigmas(pixels[i], g); },
      [&](const Vector3d&, const std::vector<int>& inliers) {
        return fit(pixels, inliers, nullptr);
      });
  InverseDepthPlane result;
  result.outcome = consensus.outcome;
  result.inliers = consensus.inliers;
  if (!consensus.outcome) return result;
  Matrix3d information;
  result.g_cam = fit(pixels, result.inliers, &information);
  double chi2 = 0;
  for (const int i : result.inliers) chi2 += squared_sigmas(pixels[i], result.g_cam);
  const double dof = static_cast<double>(result.inliers.size()) - 3;
  result.chi2_per_dof = dof > 0 ? chi2 / dof : 0;
  result.covariance =
      std::max(1.0, result.chi2_per_dof) * information.ldlt().solve(Matrix3d::Identity());
  const double length = result.g_cam.norm();
  if (!(length > 0) || !result.covariance.allFinite() ||
      !(sigma_normal_rad(result.g_cam, result.covariance) < deg_to_rad(options.max_sigma_deg)) ||
      !(sigma_log_distance(result.g_cam, result.covariance) < kMaxSigmaDistance)) {
    result.outcome =
        Outcome::failure(Outcome::Code::kDegenerate, "the pixels do not determine the plane");
    return result;
  }
  result.plane_cam = {result.g_cam / length, 1 / length};
  return result;
}

}  // namespace placegraph
