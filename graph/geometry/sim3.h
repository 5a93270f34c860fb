#pragma once
#include <placegraph/graph/geometry/se3.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A tangent of Sim(3): [translation, rotation, log scale].
using Vector7d = Eigen::Matrix<double, 7, 1>;
/// A covariance, information or Jacobian in the tangent of Sim(3).
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/// A similarity `S_a_b`: p_a = S_a_b * p_b = s R p_b + t, s > 0.
/// Tangent [translation, rotation, log scale], perturbed on the right: S [+] xi = S * exp(xi).
class Sim3 {
 public:
  static constexpr int kDof = 7;  ///< degrees of freedom: size of the tangent
  /// [translation, rotation, log scale]; rotation [rad].
  using Tangent = Vector7d;
  /// A linear map of tangents.
  using Jacobian = Matrix7d;
  /// A point that the group acts on.
  using Point = Eigen::Vector3d;

  /// The identity.
  Sim3() : t_(Eigen::Vector3d::Zero()), s_(1) {}
  /// The similarity p -> s R p + t; throws ArgumentError unless 0 < scale < infinity.
  Sim3(const SO3& rotation, const Eigen::Vector3d& translation, double scale);
  /// A rigid motion as a similarity of scale 1.
  explicit Sim3(const SE3& T) : R_(T.rotation()), t_(T.translation()), s_(1) {}

  /// The exponential map; throws ArgumentError if the scale exp(xi[6]) is not finite or zero.
  static Sim3 exp(const Tangent& xi);
  /// The inverse of `exp`, with a rotation of at most pi.
  Tangent log() const;

  /// S_b_a of S_a_b.
  Sim3 inverse() const;
  /// S_a_c = S_a_b * S_b_c.
  Sim3 operator*(const Sim3& other) const;
  /// p_a = S_a_b * p_b.
  Point operator*(const Point& p) const { return s_ * (R_ * p) + t_; }
  /// S [+] xi = S * exp(xi).
  Sim3 plus(const Tangent& xi) const { return *this * exp(xi); }

  /// R_a_b of S_a_b.
  const SO3& rotation() const { return R_; }
  /// The origin of b in frame a, at the scale of a.
  const Eigen::Vector3d& translation() const { return t_; }
  /// The scale s: lengths in a over lengths in b.
  double scale() const { return s_; }
  /// The homogeneous matrix [s R t; 0 1].
  Eigen::Matrix4d matrix() const;
  /// Ad_S with S exp(xi) = exp(Ad_S xi) S.
  Jacobian adjoint() const;

  /// The Lie bracket with xi as a matrix: exp(ad(xi)) is the adjoint of exp(xi).
  static Jacobian ad(const Tangent& xi);
  /// J with exp(xi + d) = exp(xi) exp(J d) for small d, as the series phi_1(-ad(xi)).
  static Jacobian right_jacobian(const Tangent& xi);
  /// The inverse of `right_jacobian`.
  static Jacobian right_jacobian_inverse(const Tangent& xi);

 private:
  SO3 R_;
  Eigen::Vector3d t_;
  double s_;
};

/// Rotation and translation of a similarity: a camera's pose where its scale does not matter.
inline SE3 rigid_part(const Sim3& S) { return SE3(S.rotation(), S.translation()); }

}  // namespace placegraph
