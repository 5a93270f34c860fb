#pragma once
#include <placegraph/graph/geometry/se3.h>

namespace [[gnu::visibility("default")]] placegraph {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/// A similarity `S_a_b`: p_a = s R p_b + t, s > 0. Tangent [translation, rotation, log scale],
/// perturbed on the right.
class Sim3 {
 public:
  static constexpr int kDof = 7;
  using Tangent = Vector7d;
  using Jacobian = Matrix7d;
  using Point = Eigen::Vector3d;

  Sim3() : t_(Eigen::Vector3d::Zero()), s_(1) {}
  /// Throws ArgumentError unless scale > 0 and finite.
  Sim3(const SO3& rotation, const Eigen::Vector3d& translation, double scale);
  explicit Sim3(const SE3& T) : R_(T.rotation()), t_(T.translation()), s_(1) {}

  static Sim3 exp(const Tangent& xi);
  Tangent log() const;

  Sim3 inverse() const;
  Sim3 operator*(const Sim3& other) const;
  Point operator*(const Point& p) const { return s_ * (R_ * p) + t_; }
  Sim3 plus(const Tangent& xi) const { return *this * exp(xi); }

  const SO3& rotation() const { return R_; }
  const Eigen::Vector3d& translation() const { return t_; }
  double scale() const { return s_; }
  Eigen::Matrix4d matrix() const;
  Jacobian adjoint() const;

  static Jacobian ad(const Tangent& xi);
  static Jacobian right_jacobian(const Tangent& xi);
  static Jacobian right_jacobian_inverse(const Tangent& xi);

 private:
  SO3 R_;
  Eigen::Vector3d t_;
  double s_;
};

/// A similarity without its scale: the pose of a camera whose unit of length does not matter.
inline SE3 rigid_part(const Sim3& S) { return SE3(S.rotation(), S.translation()); }

}  // namespace placegraph
