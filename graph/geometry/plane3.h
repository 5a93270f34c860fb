#pragma once
#include <placegraph/graph/geometry/se3.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A plane of space without orientation: the points with n^T p = d, |n| = 1.
/// (n, d) and (-n, -d) are the same plane. It is stored as the unit quaternion with vector part
/// n / sqrt(1 + d^2) and scalar part -d / sqrt(1 + d^2) (Kaess 2015, "Simultaneous localization and
/// mapping with infinite planes"), whose sign does not matter either. Tangent: rotation vector of
/// that quaternion, perturbed on the right: q [+] w = q exp(w). At a distance of zero the component
/// of w perpendicular to n is twice the rotation of the normal [rad], the component along n twice
/// the shift [m].
class Plane3 {
 public:
  static constexpr int kDof = 3;  ///< degrees of freedom: size of the tangent
  /// Rotation vector w of the quaternion, on the right.
  using Tangent = Eigen::Vector3d;

  /// The plane z = 0.
  Plane3() : Plane3(Eigen::Vector3d::UnitZ(), 0) {}
  /// The plane with a normal of any length, at a signed distance from the origin [m].
  /// Throws ArgumentError if the normal is zero or anything is not finite.
  Plane3(const Eigen::Vector3d& normal, double distance);
  /// The plane with the given quaternion, see above; its vector part must not be zero.
  explicit Plane3(const SO3& quaternion) : q_(quaternion) {}
  /// The plane whose point nearest to the origin is `closest` = n d [m].
  /// Throws ArgumentError if that is the origin (which leaves the normal undetermined) or not
  /// finite.
  static Plane3 from_closest_point(const Eigen::Vector3d& closest);
  /// The point nearest to the origin, n d [m], and its derivative by w.
  /// It does not depend on the sign of the quaternion. For a plane through the origin it is zero
  /// and its derivative has rank one.
  Eigen::Vector3d closest_point(Eigen::Matrix3d* J_closest = nullptr) const;

  /// The unit normal n, with the sign of the quaternion, and its derivative by w.
  Eigen::Vector3d normal(Eigen::Matrix3d* J_normal = nullptr) const;
  /// The signed distance d from the origin [m] along `normal()`, and its derivative by w.
  double distance(Eigen::RowVector3d* J_distance = nullptr) const;
  /// The stored quaternion; it and its negative represent the same plane.
  const SO3& quaternion() const { return q_; }
  /// Signed distance n^T p - d of a point [m], and its derivative by w.
  double distance_to(const Eigen::Vector3d& p, Eigen::RowVector3d* J_plane = nullptr) const;

  /// This [+] w.
  Plane3 plus(const Tangent& w) const { return Plane3(q_.plus(w)); }
  /// The tangent w with other [+] w = this.
  Tangent minus(const Plane3& other) const { return (other.q_.inverse() * q_).log(); }

 private:
  SO3 q_;
};

/// Transforms a plane from frame a to frame b: n_b = R^T n_a, d_b = d_a - n_a^T t.
/// T_a_b = (R, t). The Jacobians, if requested, are the derivatives of its tangent by T_a_b exp(xi)
/// and by the tangent of `plane_a`.
Plane3 transform_to(const SE3& T_a_b, const Plane3& plane_a,
                    Eigen::Matrix<double, 3, 6>* J_pose = nullptr,
                    Eigen::Matrix3d* J_plane = nullptr);

/// Covariance of a plane's tangent from that of its closest point [m^2].
/// Throws ArgumentError if the plane passes through the origin.
Eigen::Matrix3d tangent_covariance(const Plane3& plane, const Eigen::Matrix3d& covariance_closest);

/// Information of a plane's tangent from the standard deviations of its normal and distance.
/// `sigma_normal_rad` is that of each of the two angles of the normal, `sigma_distance_m` that of
/// the distance from the origin. Throws ArgumentError if one is not finite or not positive.
Eigen::Matrix3d plane_information(const Plane3& plane, double sigma_normal_rad,
                                  double sigma_distance_m);

}  // namespace placegraph
