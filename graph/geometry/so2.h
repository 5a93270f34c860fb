#pragma once
#include <Eigen/Core>

namespace [[gnu::visibility("default")]] placegraph {

/// A rotation of the plane, `R_a_b`: p_a = R_a_b * p_b.
/// Stored as cosine and sine. Tangent: angle [rad].
class SO2 {
 public:
  static constexpr int kDof = 1;  ///< degrees of freedom: size of the tangent
  /// The angle [rad].
  using Tangent = Eigen::Matrix<double, 1, 1>;
  /// A linear map of tangents.
  using Jacobian = Eigen::Matrix<double, 1, 1>;
  /// A point that the group acts on.
  using Point = Eigen::Vector2d;

  /// The identity.
  SO2() : c_(1), s_(0) {}
  /// The rotation by an angle [rad], from the x axis towards the y axis.
  explicit SO2(double angle);
  /// The rotation by the angle w[0] [rad].
  static SO2 exp(const Tangent& w) { return SO2(w[0]); }
  /// The angle in (-pi, pi] [rad], as a tangent.
  Tangent log() const { return Tangent(angle()); }
  /// The angle in (-pi, pi] [rad].
  double angle() const;

  /// R_b_a of R_a_b.
  SO2 inverse() const { return SO2(c_, -s_); }
  /// R_a_c = R_a_b * R_b_c, renormalized, so that long products stay rotations.
  SO2 operator*(const SO2& other) const {
    const double c = c_ * other.c_ - s_ * other.s_;
    const double s = s_ * other.c_ + c_ * other.s_;
    const double factor = 1.5 - 0.5 * (c * c + s * s);  // one Newton step towards 1 / norm
    return SO2(factor * c, factor * s);
  }
  /// p_a = R_a_b * p_b.
  Point operator*(const Point& p) const { return {c_ * p[0] - s_ * p[1], s_ * p[0] + c_ * p[1]}; }
  /// R [+] w = R * exp(w).
  SO2 plus(const Tangent& w) const { return *this * exp(w); }

  /// [cos -sin; sin cos].
  Eigen::Matrix2d matrix() const;
  /// One: rotations of the plane commute.
  Jacobian adjoint() const { return Jacobian::Identity(); }
  /// Zero: rotations of the plane commute.
  static Jacobian ad(const Tangent&) { return Jacobian::Zero(); }
  /// One: rotations of the plane commute.
  static Jacobian right_jacobian(const Tangent&) { return Jacobian::Identity(); }
  /// One, the inverse of `right_jacobian`.
  static Jacobian right_jacobian_inverse(const Tangent&) { return Jacobian::Identity(); }

 private:
  SO2(double c, double s) : c_(c), s_(s) {}
  double c_, s_;
};

}  // namespace placegraph
