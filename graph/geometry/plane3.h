#pragma once
#include <placegraph/graph/geometry/se3.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A plane of space without orientation: the points with n^T p = d, |n| = 1, where (n, d) and
/// (-n, -d) are the same. Held as the unit quaternion of vector part n / sqrt(1 + d^2) and scalar
/// part -d / sqrt(1 + d^2) (Kaess 2015, "Simultaneous localization and mapping with infinite
/// planes"), whose sign does not matter either. Tangent: rotation vector of that quaternion,
/// perturbed on the right: q [+] w = q exp(w); at a distance of zero the part of w across n is
/// twice the turn of the normal [rad], the part along n twice the shift [m].
class Plane3 {
 public:
  static constexpr int kDof = 3;
  using Tangent = Eigen::Vector3d;

  Plane3() : Plane3(Eigen::Vector3d::UnitZ(), 0) {}
  /// Throws ArgumentError if `normal` is zero or anything is not finite. Distance [m].
  Plane3(const Eigen::Vector3d& normal, double distance);
  explicit Plane3(const SO3& quaternion) : q_(quaternion) {}
  /// Of its point nearest to the origin, n d [m]. Throws ArgumentError if that is the origin (which
  /// leaves the normal open) or not finite.
  static Plane3 from_closest_point(const Eigen::Vector3d& closest);
  /// n d [m], whatever the sign of the quaternion, and its derivative by w. Of a plane through the
  /// origin it is zero, and its derivative has rank one.
  Eigen::Vector3d closest_point(Eigen::Matrix3d* J_closest = nullptr) const;

  /// n and d, both of the sign of the quaternion, and their derivatives by w.
  Eigen::Vector3d normal(Eigen::Matrix3d* J_normal = nullptr) const;
  double distance(Eigen::RowVector3d* J_distance = nullptr) const;
  const SO3& quaternion() const { return q_; }
  /// Signed distance n^T p - d of a point, and its derivative by w.
  double distance_to(const Eigen::Vector3d& p, Eigen::RowVector3d* J_plane = nullptr) const;

  Plane3 plus(const Tangent& w) const { return Plane3(q_.plus(w)); }
  /// The tangent w with other [+] w = this.
  Tangent minus(const Plane3& other) const { return (other.q_.inverse() * q_).log(); }

 private:
  SO3 q_;
};

/// A plane of frame a seen from frame b: n_b = R^T n_a, d_b = d_a - n_a^T t with T_a_b = (R, t).
/// Derivatives of its tangent by T_a_b exp(xi) and by the tangent of `plane_a`.
Plane3 transform_to(const SE3& T_a_b, const Plane3& plane_a,
                    Eigen::Matrix<double, 3, 6>* J_pose = nullptr,
                    Eigen::Matrix3d* J_plane = nullptr);

/// Covariance of a plane's tangent from that of its closest point [m^2]. Throws ArgumentError where
/// the plane passes through the origin.
Eigen::Matrix3d tangent_covariance(const Plane3& plane, const Eigen::Matrix3d& covariance_closest);

/// Information of a plane's tangent when its normal is known to `sigma_normal_rad` and its distance
/// from the origin to `sigma_distance_m`.
Eigen::Matrix3d plane_information(const Plane3& plane, double sigma_normal_rad,
                                  double sigma_distance_m);

}  // namespace placegraph
