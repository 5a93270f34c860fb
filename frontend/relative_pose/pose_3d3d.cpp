#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>

#include <Eigen/Dense>
#include <cmath>
#include <opengv/point_cloud/PointCloudAdapter.hpp>
#include <opengv/point_cloud/methods.hpp>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Cloud = std::vector<CloudPoint>;

struct Distance {
  Vector3d difference;
  Matrix3d weight;  // inverse covariance
  double squared() const { return difference.dot(weight * difference); }
};

Distance distance(const CloudPoint& ref, const CloudPoint& cur, const SE3& T_ref_cur) {
  const Matrix3d R = T_ref_cur.rotation().matrix();
  const Matrix3d covariance = ref.covariance + R * cur.covariance * R.transpose();
  return {T_ref_cur * cur.point - ref.point, covariance.inverse()};
}

/// Gauss-Newton with weights that are constant within a step.
SE3 refine(const Cloud& ref, const Cloud& cur, const std::vector<int>& indices, const SE3& T_start,
           double huber_sigmas, int iterations, Matrix6d* normal) {
  SE3 T = T_start;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Matrix3d R = T.rotation().matrix();
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (const int i : indices) {
      const Distance d = distance(ref[i], cur[i], T);
      const double sigmas = std::sqrt(d.squared());
      const double weight = sigmas > huber_sigmas ? huber_sigmas / sigmas : 1;
      Eigen::Matrix<double, 3, 6> J;  // derivative of T exp(xi) p = t + R (p + u + w x p)
      J << R, -R * hat(cur[i].point);
      const Eigen::Matrix<double, 6, 3> JW = weight * J.transpose() * d.weight;
      H.noalias() += JW * J;
      g.noalias() += JW * d.difference;
    }
    if (normal) *normal = H;
    const Vector6d step = -(H + 1e-12 * H.trace() * Matrix6d::Identity()).ldlt().solve(g);
    if (!step.allFinite()) break;
    T = T.plus(step);
    if (step.norm() < 1e-10) break;
  }
  return T;
}

std::vector<SE3> align_three(const opengv::point_cloud::PointCloudAdapter& adapter,
                             const Cloud& cur, const std::vector<int>& sample) {
  const Vector3d a = cur[sample[1]].point - cur[sample[0]].point;
  const Vector3d b = cur[sample[2]].point - cur[sample[0]].point;
  if (!(a.cross(b).norm() > 1e-3 * a.norm() * b.norm())) return {};  // on a line
  // The first cloud of the adapter is the target of the transformation.
  const opengv::transformation_t T = opengv::point_cloud::threept_arun(adapter, sample);
  const Matrix3d R = T.leftCols<3>();
  if (!T.allFinite() || (R.transpose() * R - Matrix3d::Identity()).norm() > 1e-3 ||
      R.determinant() < 0)
    return {};
  return {SE3(R, Vector3d(T.col(3)))};
}

}  // namespace

CloudPoint cloud_point(const Camera& camera, const Eigen::Vector2d& px, double inverse_depth,
                       double sigma_px, double sigma_inverse_depth) {
  const auto ray = camera.unproject(px);
  require(ray.has_value(), "cloud_point: a pixel outside the lens model");
  require(inverse_depth > 0, "cloud_point: inverse depth must be positive");
  const double depth = 1 / inverse_depth;
  CloudPoint result{depth * *ray, Matrix3d::Zero()};
  const double across_x = depth * sigma_px / camera.fx, across_y = depth * sigma_px / camera.fy;
  const Vector3d along = depth * depth * sigma_inverse_depth * *ray;
  result.covariance = along * along.transpose();
  result.covariance(0, 0) += across_x * across_x;
  result.covariance(1, 1) += across_y * across_y;
  return result;
}

Pose3d3dResult estimate_pose_3d3d(const Cloud& points_ref, const Cloud& points_cur,
                                  const Pose3d3dOptions& options, Random& random) {
  options.check();
  require(points_ref.size() == points_cur.size(),
          "estimate_pose_3d3d: as many points in both clouds needed");
  const int n = static_cast<int>(points_ref.size());
  opengv::points_t ref(n), cur(n);
  for (int i = 0; i < n; ++i) {
    ref[i] = points_ref[i].point;
    cur[i] = points_cur[i].point;
  }
  const opengv::point_cloud::PointCloudAdapter adapter(ref, cur);
  const double huber = options.threshold_sigmas / 2;
  const auto consensus = ransac<SE3>(
      n, 3, options.threshold_sigmas * options.threshold_sigmas, options.ransac, random,
      [&](const std::vector<int>& sample) { return align_three(adapter, points_cur, sample); },
      [&](const SE3& T_ref_cur, int i) {
        return distance(points_ref[i], points_cur[i], T_ref_cur).squared();
      },
      [&](const SE3& T_ref_cur, const std::vector<int>& inliers) {
        return refine(points_ref, points_cur, inliers, T_ref_cur, huber, 3, nullptr);
      });
  Pose3d3dResult result;
  result.outcome = consensus.outcome;
  result.inliers = consensus.inliers;
  if (!consensus.outcome) return result;
  Matrix6d normal = Matrix6d::Zero();
  result.T_ref_cur =
      refine(points_ref, points_cur, result.inliers, consensus.model, huber, 10, &normal);
  double chi2 = 0;
  for (const int i : result.inliers)
    chi2 += distance(points_ref[i], points_cur[i], result.T_ref_cur).squared();
  const double dof = 3.0 * static_cast<double>(result.inliers.size()) - 6;
  result.chi2_per_dof = dof > 0 ? chi2 / dof : 0;
  result.information = normal / std::max(1.0, result.chi2_per_dof);
  // Scaled to a unit diagonal, so that metres and radians are comparable.
  const Vector6d scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(
      Matrix6d(scale.asDiagonal() * normal * scale.asDiagonal()), Eigen::EigenvaluesOnly);
  if (!(eigen.eigenvalues()[0] > 1e-9))
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                      "the points do not determine all six degrees of freedom");
  return result;
}

}  // namespace placegraph
