#pragma once
#include <placegraph/graph/geometry/so3.h>

namespace [[gnu::visibility("default")]] placegraph {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion `T_a_b`: p_a = T_a_b * p_b = R p_b + t. Tangent [translation, rotation],
/// perturbed on the right: T [+] xi = T * exp(xi).
class SE3 {
 public:
  static constexpr int kDof = 6;
  using Tangent = Vector6d;
  using Jacobian = Matrix6d;
  using Point = Eigen::Vector3d;

  SE3() : t_(Eigen::Vector3d::Zero()) {}
  SE3(const SO3& rotation, const Eigen::Vector3d& translation) : R_(rotation), t_(translation) {}
  SE3(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : R_(SO3::from_matrix(rotation)), t_(translation) {}
  /// Rotation re-orthonormalized as SO3::from_matrix does.
  explicit SE3(const Eigen::Isometry3d& T)
      : SE3(Eigen::Matrix3d(T.linear()), Eigen::Vector3d(T.translation())) {}

  static SE3 exp(const Tangent& xi);
  Tangent log() const;

  SE3 inverse() const {
    const SO3 R_inverse = R_.inverse();
    return SE3(R_inverse, -(R_inverse * t_));
  }
  SE3 operator*(const SE3& other) const { return SE3(R_ * other.R_, t_ + R_ * other.t_); }
  Point operator*(const Point& p) const { return R_ * p + t_; }
  SE3 plus(const Tangent& xi) const { return *this * exp(xi); }
  /// The same motion in another unit of length: its translation times `factor`.
  SE3 scaled(double factor) const { return SE3(R_, factor * t_); }

  const SO3& rotation() const { return R_; }
  const Eigen::Vector3d& translation() const { return t_; }
  Eigen::Matrix4d matrix() const;
  Eigen::Isometry3d isometry() const;
  Jacobian adjoint() const;

  static Jacobian ad(const Tangent& xi);
  static Jacobian right_jacobian(const Tangent& xi);  ///< Barfoot 2017, eq. 7.86, closed form
  static Jacobian right_jacobian_inverse(const Tangent& xi);

 private:
  SO3 R_;
  Eigen::Vector3d t_;
};

}  // namespace placegraph
