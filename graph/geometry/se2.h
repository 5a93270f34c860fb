#pragma once
#include <placegraph/graph/geometry/so2.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A rigid motion of the plane, `T_a_b`: p_a = T_a_b * p_b = R p_b + t.
/// Tangent [x, y, angle], perturbed on the right: T [+] xi = T * exp(xi).
class SE2 {
 public:
  static constexpr int kDof = 3;  ///< degrees of freedom: size of the tangent
  /// [x, y, angle], rad.
  using Tangent = Eigen::Vector3d;
  /// A linear map of tangents.
  using Jacobian = Eigen::Matrix3d;
  /// A point that the group acts on.
  using Point = Eigen::Vector2d;

  /// The identity.
  SE2() : t_(Eigen::Vector2d::Zero()) {}
  /// The motion p -> R p + t.
  SE2(const SO2& rotation, const Eigen::Vector2d& translation) : R_(rotation), t_(translation) {}
  /// The motion with the given translation and rotation angle [rad].
  SE2(double x, double y, double angle) : R_(angle), t_(x, y) {}

  /// The exponential map: a constant twist xi for unit time.
  static SE2 exp(const Tangent& xi);
  /// The inverse of `exp`, with the angle in (-pi, pi].
  Tangent log() const;

  /// T_b_a of T_a_b.
  SE2 inverse() const;
  /// T_a_c = T_a_b * T_b_c.
  SE2 operator*(const SE2& other) const { return SE2(R_ * other.R_, t_ + R_ * other.t_); }
  /// p_a = T_a_b * p_b.
  Point operator*(const Point& p) const { return R_ * p + t_; }
  /// T [+] xi = T * exp(xi).
  SE2 plus(const Tangent& xi) const { return *this * exp(xi); }

  /// R_a_b of T_a_b.
  const SO2& rotation() const { return R_; }
  /// The origin of b in frame a.
  const Eigen::Vector2d& translation() const { return t_; }
  /// The homogeneous matrix [R t; 0 1].
  Eigen::Matrix3d matrix() const;
  /// Ad_T with T exp(xi) = exp(Ad_T xi) T.
  Jacobian adjoint() const;

  /// The Lie bracket with xi as a matrix: exp(ad(xi)) is the adjoint of exp(xi).
  static Jacobian ad(const Tangent& xi);
  /// J with exp(xi + d) = exp(xi) exp(J d) for small d (Sola et al. 2018, eq. 163).
  static Jacobian right_jacobian(const Tangent& xi);
  /// The inverse of `right_jacobian`, in closed form.
  static Jacobian right_jacobian_inverse(const Tangent& xi);

 private:
  SO2 R_;
  Eigen::Vector2d t_;
};

}  // namespace placegraph
