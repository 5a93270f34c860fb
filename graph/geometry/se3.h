#pragma once
#include <placegraph/graph/geometry/so3.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A tangent of SE(3): [translation, rotation].
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// A covariance, information or Jacobian in the tangent of SE(3).
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion `T_a_b`: p_a = T_a_b * p_b = R p_b + t.
/// Tangent [translation, rotation], perturbed on the right: T [+] xi = T * exp(xi).
class SE3 {
 public:
  static constexpr int kDof = 6;  ///< degrees of freedom: size of the tangent
  /// [translation, rotation]; rotation [rad].
  using Tangent = Vector6d;
  /// A linear map of tangents.
  using Jacobian = Matrix6d;
  /// A point that the group acts on.
  using Point = Eigen::Vector3d;

  /// The identity.
  SE3() : t_(Eigen::Vector3d::Zero()) {}
  /// The motion p -> R p + t.
  SE3(const SO3& rotation, const Eigen::Vector3d& translation) : R_(rotation), t_(translation) {}
  /// The same from a rotation matrix, which is re-orthonormalized; throws as SO3::from_matrix.
  SE3(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : R_(SO3::from_matrix(rotation)), t_(translation) {}
  /// The same from Eigen's type, re-orthonormalized; throws as SO3::from_matrix.
  explicit SE3(const Eigen::Isometry3d& T)
      : SE3(Eigen::Matrix3d(T.linear()), Eigen::Vector3d(T.translation())) {}

  /// The exponential map: a constant twist xi for unit time.
  static SE3 exp(const Tangent& xi);
  /// The inverse of `exp`, with a rotation of at most pi.
  Tangent log() const;

  /// T_b_a of T_a_b.
  SE3 inverse() const {
    const SO3 R_inverse = R_.inverse();
    return SE3(R_inverse, -(R_inverse * t_));
  }
  /// T_a_c = T_a_b * T_b_c.
  SE3 operator*(const SE3& other) const { return SE3(R_ * other.R_, t_ + R_ * other.t_); }
  /// p_a = T_a_b * p_b.
  Point operator*(const Point& p) const { return R_ * p + t_; }
  /// T [+] xi = T * exp(xi).
  SE3 plus(const Tangent& xi) const { return *this * exp(xi); }
  /// The same motion at another scale: its translation times `factor`.
  SE3 scaled(double factor) const { return SE3(R_, factor * t_); }

  /// R_a_b of T_a_b.
  const SO3& rotation() const { return R_; }
  /// The origin of b in frame a.
  const Eigen::Vector3d& translation() const { return t_; }
  /// The homogeneous matrix [R t; 0 1].
  Eigen::Matrix4d matrix() const;
  /// The same as Eigen's type.
  Eigen::Isometry3d isometry() const;
  /// Ad_T with T exp(xi) = exp(Ad_T xi) T.
  Jacobian adjoint() const;

  /// The Lie bracket with xi as a matrix: exp(ad(xi)) is the adjoint of exp(xi).
  static Jacobian ad(const Tangent& xi);
  /// J with exp(xi + d) = exp(xi) exp(J d) for small d (Barfoot 2017, eq. 7.86).
  static Jacobian right_jacobian(const Tangent& xi);
  /// The inverse of `right_jacobian`, in closed form.
  static Jacobian right_jacobian_inverse(const Tangent& xi);

 private:
  SO3 R_;
  Eigen::Vector3d t_;
};

}  // namespace placegraph
