#pragma once
#include <Eigen/Core>

namespace placegraph {

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

  SO2 inverse() const;
  SO2 operator*(const SO2& other) const;
  Point operator*(const Point& p) const { return {c_ * p[0] - s_ * p[1], s_ * p[0] + c_ * p[1]}; }
  SO2 plus(const Tangent& w) const { return *this * exp(w); }

  Eigen::Matrix2d matrix() const;
  Jacobian adjoint() const { return Jacobian::Identity(); }
  static Jacobian ad(const Tangent&) { return Jacobian::Zero(); }
  static Jacobian right_jacobian(const Tangent&) { return Jacobian::Identity(); }
  static Jacobian right_jacobian_inverse(const Tangent&) { return Jacobian::Identity(); }

 private:
  double c_, s_;
};

}  // namespace placegraph
