#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

// The library is built with this alignment of Eigen types, and the targets of its CMake package
// pass it on: with another alignment (as by -mavx) a program would have another memory layout.
static_assert(EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MALLOC_ALREADY_ALIGNED == 1,
              "compile with -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1, as the "
              "targets placegraph::* do");

namespace [[gnu::visibility("default")]] placegraph {

/// The 3x3 matrix with hat(a) * b = a x b.
inline Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return A;
}

/// A rotation `R_a_b`: p_a = R_a_b * p_b.
/// Stored as a unit quaternion. Tangent: rotation vector [rad], perturbed on the right:
/// R [+] w = R * exp(w).
class SO3 {
 public:
  static constexpr int kDof = 3;  ///< degrees of freedom: size of the tangent
  /// Rotation vector: axis times angle [rad].
  using Tangent = Eigen::Vector3d;
  /// A linear map of tangents.
  using Jacobian = Eigen::Matrix3d;
  /// A point that the group acts on.
  using Point = Eigen::Vector3d;

  /// The identity.
  SO3() : q_(Eigen::Quaterniond::Identity()) {}
  /// The rotation of a quaternion, which is normalized.
  /// Throws ArgumentError if it is zero or not finite. A quaternion of unit length within rounding
  /// is stored unchanged, bit by bit.
  explicit SO3(const Eigen::Quaterniond& q);
  /// The rotation nearest to `R` in the Frobenius norm.
  /// Throws ArgumentError if `R` is not finite, is a reflection, or is further than 1e-2 (largest
  /// singular value of R^T R - I) from a rotation.
  static SO3 from_matrix(const Eigen::Matrix3d& R);

  /// The rotation about w by the angle |w| [rad].
  static SO3 exp(const Tangent& w);
  /// The inverse of `exp`, with |log| <= pi.
  Tangent log() const;

  /// R_b_a of R_a_b.
  SO3 inverse() const { return SO3(q_.conjugate(), Unit{}); }
  /// R_a_c = R_a_b * R_b_c, renormalized, so that long products stay rotations.
  SO3 operator*(const SO3& other) const {
    Eigen::Quaterniond q = q_ * other.q_;
    q.coeffs() *= 1.5 - 0.5 * q.squaredNorm();  // one Newton step towards 1 / norm
    return SO3(q, Unit{});
  }
  /// p_a = R_a_b * p_b.
  Point operator*(const Point& p) const { return q_ * p; }
  /// R [+] w = R * exp(w).
  SO3 plus(const Tangent& w) const { return *this * exp(w); }

  /// The rotation matrix.
  Eigen::Matrix3d matrix() const { return q_.toRotationMatrix(); }
  /// The stored unit quaternion, one of the two that represent this rotation.
  const Eigen::Quaterniond& quaternion() const { return q_; }
  /// Ad_R = R, with R exp(w) = exp(Ad_R w) R.
  Jacobian adjoint() const { return matrix(); }

  /// The Lie bracket with w as a matrix, hat(w): exp(ad(w)) is the adjoint of exp(w).
  static Jacobian ad(const Tangent& w) { return hat(w); }
  /// d log(exp(w)^-1 exp(w + dw)) / d dw at 0 (Sola et al. 2018, eq. 143).
  static Jacobian right_jacobian(const Tangent& w);
  /// The inverse of `right_jacobian` (Sola et al. 2018, eq. 144).
  static Jacobian right_jacobian_inverse(const Tangent& w);

 private:
  struct Unit {};  ///< marks a quaternion that has unit length already
  SO3(const Eigen::Quaterniond& q, Unit) : q_(q) {}
  Eigen::Quaterniond q_;
};

}  // namespace placegraph
