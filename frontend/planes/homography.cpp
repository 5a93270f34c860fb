#include <placegraph/frontend/planes/homography.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace placegraph {
namespace {

/// K^-1 H K, scaled like a plane-induced motion: middle singular value one, and points that stay in
/// front of the camera.
Eigen::Matrix3d normalized(const Eigen::Matrix3d& K, const Eigen::Matrix3d& H_cur_ref) {
  const Eigen::Matrix3d M = K.inverse() * H_cur_ref * K;
  const Eigen::Vector3d singular = Eigen::JacobiSVD<Eigen::Matrix3d>(M).singularValues();
  require(M.allFinite() && singular[1] > 1e-12 * singular[0], "homography: singular matrix");
  return M * (M.determinant() < 0 ? -1 : 1) / singular[1];
}

}  // namespace

Plane transform(const SE3& T_cur_ref, const Plane& plane_ref) {
  Plane plane;
  plane.normal = T_cur_ref.rotation() * plane_ref.normal;
  plane.distance_m = plane_ref.distance_m + plane.normal.dot(T_cur_ref.translation());
  return plane;
}

Eigen::Matrix3d homography_from_plane(const Eigen::Matrix3d& K, const SE3& T_cur_ref,
                                      const Plane& plane_ref) {
  require(plane_ref.distance_m > 0, "homography_from_plane: distance_m must be positive");
  return K *
         (T_cur_ref.rotation().matrix() +
          T_cur_ref.translation() * plane_ref.normal.transpose() / plane_ref.distance_m) *
         K.inverse();
}

std::vector<HomographyMotion> decompose_homography(const Eigen::Matrix3d& K,
                                                   const Eigen::Matrix3d& H_cur_ref,
                                                   const std::vector<Eigen::Vector2d>& px_ref) {
  cv::Mat H_cv, K_cv;
  cv::eigen2cv(Eigen::Matrix3d(K * normalized(K, H_cur_ref) * K.inverse()), H_cv);
  cv::eigen2cv(K, K_cv);
  std::vector<cv::Mat> rotations, translations, normals;
  cv::decomposeHomographyMat(H_cv, K_cv, rotations, translations, normals);

  const Eigen::Matrix3d K_inverse = K.inverse();
  std::vector<HomographyMotion> motions;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    Eigen::Matrix3d R;
    Eigen::Vector3d t, n;
    cv::cv2eigen(rotations[i], R);
    cv::cv2eigen(translations[i], t);
    cv::cv2eigen(normals[i], n);
    if (!R.allFinite() || !t.allFinite() || !n.allFinite()) continue;
    int front = 0;
    for (const Eigen::Vector2d& px : px_ref) front += n.dot(K_inverse * px.homogeneous()) > 0;
    // A few pixels of wrong matches may be beyond the horizon.
    if (front < 0.9 * px_ref.size()) continue;
    motions.push_back({SE3(R, t), n});
  }
  return motions;
}

SE3 motion_from_homography(const Eigen::Matrix3d& K, const Eigen::Matrix3d& H_cur_ref,
                           const Eigen::Vector3d& normal_ref) {
  require(std::abs(normal_ref.norm() - 1) < 1e-6,
          "motion_from_homography: the normal is not of unit length");
  const Eigen::Matrix3d M = normalized(K, H_cur_ref);
  const Eigen::Vector3d u = normal_ref.unitOrthogonal();
  const Eigen::Vector3d v = normal_ref.cross(u);
  Eigen::Matrix3d moved, basis;
  moved << M * u, M * v, (M * u).cross(M * v);
  basis << u, v, normal_ref;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moved * basis.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  const Eigen::Matrix3d R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return SE3(R, (M - R) * normal_ref);
}

}  // namespace placegraph
