#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

// The library's own alignment, which the targets of its CMake package hand on: a program whose Eigen
// types are aligned otherwise (by -mavx) would disagree with it on their layout.
static_assert(EIGEN_MAX_ALIGN_BYTES == 16,
              "compile with -DEIGEN_MAX_ALIGN_BYTES=16, as the targets placegraph::* do");

namespace [[gnu::visibility("default")]] placegraph {

/// The 3x3 matrix with hat(a) * b = a x b.
inline Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return A;
}

/// A rotation `R_a_b`: p_a = R_a_b * p_b. Held as a unit quaternion. Tangent: rotation vector
/// [rad], perturbed on the right: R [+] w = R * exp(w).
class SO3 {
 public:
  static constexpr int kDof = 3;
  using Tangent = Eigen::Vector3d;
  using Jacobian = Eigen::Matrix3d;
  using Point = Eigen::Vector3d;

  SO3() : q_(Eigen::Quaterniond::Identity()) {}
  /// Normalizes `q`; throws ArgumentError if it is zero or not finite.
  explicit SO3(const Eigen::Quaterniond& q);
  /// The rotation nearest to `R` in the Frobenius norm; throws ArgumentError if `R` is not finite,
  /// mirrors, or is further than 1e-2 (largest singular value of R^T R - I) from a rotation.
  static SO3 from_matrix(const Eigen::Matrix3d& R);

  static SO3 exp(const Tangent& w);
  Tangent log() const;  ///< |log| <= pi

  SO3 inverse() const { return SO3(q_.conjugate(), Unit{}); }
  SO3 operator*(const SO3& other) const {  ///< renormalized
    Eigen::Quaterniond q = q_ * other.q_;
    q.coeffs() *= 1.5 - 0.5 * q.squaredNorm();  // one Newton step towards 1 / norm
    return SO3(q, Unit{});
  }
  Point operator*(const Point& p) const { return q_ * p; }
  SO3 plus(const Tangent& w) const { return *this * exp(w); }

  Eigen::Matrix3d matrix() const { return q_.toRotationMatrix(); }
  const Eigen::Quaterniond& quaternion() const { return q_; }
  Jacobian adjoint() const { return matrix(); }

  static Jacobian ad(const Tangent& w) { return hat(w); }  ///< little adjoint
  /// d log(exp(w)^-1 exp(w + dw)) / d dw at 0 (Sola et al. 2018, eq. 143).
  static Jacobian right_jacobian(const Tangent& w);
  static Jacobian right_jacobian_inverse(const Tangent& w);

 private:
  struct Unit {};  ///< the caller knows that the quaternion is of unit length
  SO3(const Eigen::Quaterniond& q, Unit) : q_(q) {}
  Eigen::Quaterniond q_;
};

}  // namespace placegraph
