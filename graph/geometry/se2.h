#pragma once
#include <placegraph/graph/geometry/so2.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A rigid motion of the plane, `T_a_b`. Tangent [x, y, angle], perturbed on the right.
class SE2 {
 public:
  static constexpr int kDof = 3;
  using Tangent = Eigen::Vector3d;
  using Jacobian = Eigen::Matrix3d;
  using Point = Eigen::Vector2d;

  SE2() : t_(Eigen::Vector2d::Zero()) {}
  SE2(const SO2& rotation, const Eigen::Vector2d& translation) : R_(rotation), t_(translation) {}
  SE2(double x, double y, double angle) : R_(angle), t_(x, y) {}

  static SE2 exp(const Tangent& xi);
  Tangent log() const;

  SE2 inverse() const;
  SE2 operator*(const SE2& other) const { return SE2(R_ * other.R_, t_ + R_ * other.t_); }
  Point operator*(const Point& p) const { return R_ * p + t_; }
  SE2 plus(const Tangent& xi) const { return *this * exp(xi); }

  const SO2& rotation() const { return R_; }
  const Eigen::Vector2d& translation() const { return t_; }
  Eigen::Matrix3d matrix() const;
  Jacobian adjoint() const;

  static Jacobian ad(const Tangent& xi);
  static Jacobian right_jacobian(const Tangent& xi);
  static Jacobian right_jacobian_inverse(const Tangent& xi);

 private:
  SO2 R_;
  Eigen::Vector2d t_;
};

}  // namespace placegraph
