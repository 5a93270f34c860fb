#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/plane3.h>

#include <Eigen/LU>
#include <cmath>

namespace placegraph {
namespace {

using Homogeneous = Eigen::Vector4d;  // [n, -d] up to a factor
using Jacobian34 = Eigen::Matrix<double, 3, 4>;
using Jacobian43 = Eigen::Matrix<double, 4, 3>;

/// d q / d w of q exp(w), in the order [vector, scalar].
Jacobian43 quaternion_by_tangent(const Eigen::Quaterniond& q) {
  Jacobian43 J;
  J.topRows<3>() = 0.5 * (q.w() * Eigen::Matrix3d::Identity() + hat(q.vec()));
  J.row(3) = -0.5 * q.vec().transpose();
  return J;
}

/// The tangent of a change of a quaternion: w = 2 vec(q^* dq).
Jacobian34 tangent_by_quaternion(const Eigen::Quaterniond& q) {
  return 4 * quaternion_by_tangent(q).transpose();
}

SO3 unit_quaternion(const Homogeneous& x) {
  return SO3(Eigen::Quaterniond(x[3], x[0], x[1], x[2]));
}

}  // namespace

Plane3::Plane3(const Eigen::Vector3d& normal, double distance) {
  const double length = normal.norm();
  require(std::isfinite(distance) && std::isfinite(length) && length > 0,
          "plane: the normal must be finite and not zero, the distance finite");
  Homogeneous x;
  x << normal / length, -distance;
  q_ = unit_quaternion(x);
}

Plane3 Plane3::from_closest_point(const Eigen::Vector3d& closest) {
  const double distance = closest.norm();
  require(std::isfinite(distance) && distance > 0,
          "plane: a closest point must be finite and not the origin");
  return Plane3(closest, distance);
}

Eigen::Vector3d Plane3::closest_point(Eigen::Matrix3d* J_closest) const {
  if (!J_closest) return distance() * normal();
  Eigen::Matrix3d J_normal;
  Eigen::RowVector3d J_distance;
  const Eigen::Vector3d n = normal(&J_normal);
  const double d = distance(&J_distance);
  *J_closest = d * J_normal + n * J_distance;
  return d * n;
}

Eigen::Vector3d Plane3::normal(Eigen::Matrix3d* J_normal) const {
  const Eigen::Vector3d v = q_.quaternion().vec();
  const double length = v.norm();
  const Eigen::Vector3d n = v / length;
  if (J_normal)
    J_normal->noalias() = (Eigen::Matrix3d::Identity() - n * n.transpose()) / length *
                          quaternion_by_tangent(q_.quaternion()).topRows<3>();
  return n;
}

double Plane3::distance(Eigen::RowVector3d* J_distance) const {
  const Eigen::Quaterniond& q = q_.quaternion();
  const double length = q.vec().norm();
  if (J_distance) {
    const Jacobian43 J = quaternion_by_tangent(q);
    *J_distance = -J.row(3) / length + q.w() / (length * length * length) *
                                           Eigen::RowVector3d(q.vec().transpose()) * J.topRows<3>();
  }
  return -q.w() / length;
}

double Plane3::distance_to(const Eigen::Vector3d& p, Eigen::RowVector3d* J_plane) const {
  if (!J_plane) return normal().dot(p) - distance();
  Eigen::Matrix3d J_normal;
  Eigen::RowVector3d J_distance;
  const double signed_distance = normal(&J_normal).dot(p) - distance(&J_distance);
  *J_plane = p.transpose() * J_normal - J_distance;
  return signed_distance;
}

Plane3 transform_to(const SE3& T_a_b, const Plane3& plane_a, Eigen::Matrix<double, 3, 6>* J_pose,
                    Eigen::Matrix3d* J_plane) {
  const Eigen::Quaterniond& q_a = plane_a.quaternion().quaternion();
  // x_b = T_a_b^T x_a, and T exp(xi) changes it by xi^T x_b.
  const Eigen::Matrix4d A = T_a_b.matrix().transpose();
  const Homogeneous x = A * Homogeneous(q_a.x(), q_a.y(), q_a.z(), q_a.w());
  const double length = x.norm();
  const Plane3 plane_b(unit_quaternion(x / length));
  if (!J_pose && !J_plane) return plane_b;
  // 2 vec(q^* dq) of a change along q itself is zero: no projection is needed.
  const Jacobian34 J_b_x = tangent_by_quaternion(plane_b.quaternion().quaternion()) / length;
  if (J_pose) {
    Eigen::Matrix<double, 4, 6> J_x_xi = Eigen::Matrix<double, 4, 6>::Zero();
    J_x_xi.topRightCorner<3, 3>() = hat(x.head<3>());
    J_x_xi.bottomLeftCorner<1, 3>() = x.head<3>().transpose();
    J_pose->noalias() = J_b_x * J_x_xi;
  }
  if (J_plane) J_plane->noalias() = J_b_x * A * quaternion_by_tangent(q_a);
  return plane_b;
}

Eigen::Matrix3d tangent_covariance(const Plane3& plane, const Eigen::Matrix3d& covariance_closest) {
  require(plane.distance() != 0,
          "plane: with a closest point at the origin the normal is undetermined");
  Eigen::Matrix3d J;
  plane.closest_point(&J);
  const Eigen::Matrix3d J_inverse = J.inverse();
  return J_inverse * covariance_closest * J_inverse.transpose();
}

Eigen::Matrix3d plane_information(const Plane3& plane, double sigma_normal_rad,
                                  double sigma_distance_m) {
  require(std::isfinite(sigma_normal_rad) && sigma_normal_rad > 0 &&
              std::isfinite(sigma_distance_m) && sigma_distance_m > 0,
          "plane: standard deviations must be finite and positive");
  // From the tangent to two rotations perpendicular to n and the distance.
  Eigen::Matrix3d J_normal;
  Eigen::RowVector3d J_distance;
  const Eigen::Vector3d n = plane.normal(&J_normal);
  plane.distance(&J_distance);
  const Eigen::Vector3d a = n.unitOrthogonal();
  Eigen::Matrix3d W;
  W << a.transpose() * J_normal / sigma_normal_rad,
      n.cross(a).transpose() * J_normal / sigma_normal_rad, J_distance / sigma_distance_m;
  return W.transpose() * W;
}

}  // namespace placegraph
