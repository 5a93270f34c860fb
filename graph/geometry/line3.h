#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// An infinite line of space in Pluecker coordinates (m, v): direction v and moment m = p x v for
/// any point p of it, both up to one common factor. Held in the orthonormal form of Bartoli & Sturm
/// 2005: U in SO(3) with columns m/|m|, v/|v| and their cross product, and the angle of W in SO(2)
/// with (|m|, |v|) ~ (cos, sin), so that it has four parameters and no singularity. Tangent: [turn
/// of U on the right, change of the angle].
class Line3 {
 public:
  static constexpr int kDof = 4;
  using Tangent = Eigen::Vector4d;
  using Coordinates = Eigen::Matrix<double, 6, 1>;  ///< [m, v], of unit length

  /// The x axis.
  Line3();
  Line3(const SO3& U, double angle) : U_(U), angle_(angle) {}
  /// Through a point along a direction. Throws ArgumentError if the direction is zero or anything
  /// is not finite.
  static Line3 from_direction(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

  Coordinates coordinates(Eigen::Matrix<double, 6, 4>* J = nullptr) const;
  Eigen::Vector3d direction() const { return U_.matrix().col(1); }  ///< of unit length
  /// The point nearest to the origin.
  Eigen::Vector3d nearest_point() const;
  double distance_to(const Eigen::Vector3d& point) const;
  const SO3& U() const { return U_; }
  double angle() const { return angle_; }

  Line3 plus(const Tangent& x) const { return {U_.plus(x.head<3>()), angle_ + x[3]}; }
  /// The tangent x with other [+] x = this.
  Tangent minus(const Line3& other) const;

 private:
  SO3 U_;
  double angle_;
};

/// Pluecker coordinates of a line of frame a in frame b: v_b = R^T v_a, m_b = R^T (m_a - t x v_a)
/// with T_a_b = (R, t). Derivatives by T_a_b exp(xi) and by the tangent of the line:
///
///   d m_b / d xi = [hat(v_b), hat(m_b)],   d v_b / d xi = [0, hat(v_b)]
Line3::Coordinates transform_to(const SE3& T_a_b, const Line3& line_a,
                                Eigen::Matrix<double, 6, 6>* J_pose = nullptr,
                                Eigen::Matrix<double, 6, 4>* J_line = nullptr);

/// Where two planes n^T p = d meet; nothing if they are parallel (sine of the angle below 1e-9).
std::optional<Line3> meet(const Eigen::Vector3d& normal_a, double distance_a,
                          const Eigen::Vector3d& normal_b, double distance_b);

}  // namespace placegraph
