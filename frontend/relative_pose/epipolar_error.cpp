#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace placegraph {

using Eigen::Matrix3d;
using Eigen::Vector3d;

EpipolarError::EpipolarError(const Camera& camera, const SE3& T_ref_cur)
    : focal_px_(0.5 * (camera.fx + camera.fy)) {
  const Matrix3d R = T_ref_cur.rotation().matrix(), cross = hat(T_ref_cur.translation());
  E_ = cross * R;
  for (int k = 0; k < 3; ++k) {
    dE_[k] = hat(R.col(k)) * R;
    dE_[3 + k] = E_ * hat(Vector3d::Unit(k));
  }
}

double EpipolarError::operator()(const Vector3d& x_ref, const Vector3d& x_cur,
                                 Eigen::Matrix<double, 1, 6>* J) const {
  const Vector3d a = E_ * x_cur, b = E_.transpose() * x_ref;
  const double e = x_ref.dot(a);
  const double s2 = a.head<2>().squaredNorm() + b.head<2>().squaredNorm();
  const double s = std::sqrt(s2);
  if (J)
    for (int k = 0; k < 6; ++k) {
      const Vector3d da = dE_[k] * x_cur, db = dE_[k].transpose() * x_ref;
      const double ds2 = a.head<2>().dot(da.head<2>()) + b.head<2>().dot(db.head<2>());
      (*J)[k] = focal_px_ / s * (x_ref.dot(da) - e * ds2 / s2);
    }
  return focal_px_ * e / s;
}

TwoViewParallax two_view_parallax(const Camera& camera, const SE3& T_ref_cur,
                                  const std::vector<Vector3d>& x_ref,
                                  const std::vector<Vector3d>& x_cur,
                                  const std::vector<int>& indices) {
  TwoViewParallax result;
  std::vector<double> moved_px;
  const double f = 0.5 * (camera.fx + camera.fy);
  const Vector3d& t = T_ref_cur.translation();
  for (int i : indices) {
    const Vector3d& a = x_ref[i];
    const Vector3d b = T_ref_cur.rotation() * x_cur[i];
    if (b.z() > 1e-6) moved_px.push_back(f * (b.hnormalized() - a.head<2>()).norm());
    // depth_ref a = t + depth_cur b, by least squares
    Eigen::Matrix2d M;
    M << a.dot(a), -a.dot(b), -a.dot(b), b.dot(b);
    const Eigen::Vector2d depths = M.inverse() * Eigen::Vector2d(a.dot(t), -b.dot(t));
    result.ahead += depths.minCoeff() > 0;
    result.behind += depths.maxCoeff() < 0;
  }
  if (!moved_px.empty()) {
    const auto middle = moved_px.begin() + static_cast<std::ptrdiff_t>(moved_px.size() / 2);
    std::nth_element(moved_px.begin(), middle, moved_px.end());
    result.median_px = *middle;
  }
  return result;
}

std::vector<Vector3d> rays_of(const Camera& camera, const std::vector<Eigen::Vector2d>& px) {
  std::vector<Vector3d> rays;
  rays.reserve(px.size());
  for (const Eigen::Vector2d& p : px) {
    const auto ray = camera.unproject(p);
    require(ray.has_value(), "rays_of: a pixel outside the lens model");
    rays.push_back(*ray);
  }
  return rays;
}

}  // namespace placegraph
