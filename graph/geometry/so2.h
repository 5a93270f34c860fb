#pragma once
#include <Eigen/Core>

namespace [[gnu::visibility("default")]] placegraph {

/// A rotation of the plane, `R_a_b`. Tangent: angle [rad], log in (-pi, pi].
class SO2 {
 public:
  static constexpr int kDof = 1;
  using Tangent = Eigen::Matrix<double, 1, 1>;
  using Jacobian = Eigen::Matrix<double, 1, 1>;
  using Point = Eigen::Vector2d;

  SO2() : c_(1), s_(0) {}
  explicit SO2(double angle);
  static SO2 exp(const Tangent& w) { return SO2(w[0]); }
  Tangent log() const { return Tangent(angle()); }
  double angle() const;

  SO2 inverse() const { return SO2(c_, -s_); }
  SO2 operator*(const SO2& other) const {  ///< renormalized
    const double c = c_ * other.c_ - s_ * other.s_;
    const double s = s_ * other.c_ + c_ * other.s_;
    const double factor = 1.5 - 0.5 * (c * c + s * s);  // one Newton step towards 1 / norm
    return SO2(factor * c, factor * s);
  }
  Point operator*(const Point& p) const { return {c_ * p[0] - s_ * p[1], s_ * p[0] + c_ * p[1]}; }
  SO2 plus(const Tangent& w) const { return *this * exp(w); }

  Eigen::Matrix2d matrix() const;
  Jacobian adjoint() const { return Jacobian::Identity(); }
  static Jacobian ad(const Tangent&) { return Jacobian::Zero(); }
  static Jacobian right_jacobian(const Tangent&) { return Jacobian::Identity(); }
  static Jacobian right_jacobian_inverse(const Tangent&) { return Jacobian::Identity(); }

 private:
  SO2(double c, double s) : c_(c), s_(s) {}
  double c_, s_;
};

}  // namespace placegraph
