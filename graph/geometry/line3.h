#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// An infinite line of space in Pluecker coordinates (m, v), up to one common factor:
/// direction v and moment m = p x v for any point p of the line.
///
/// It is stored in the orthonormal form of Bartoli & Sturm 2005: U in SO(3) with columns m/|m|,
/// v/|v| and their cross product, and the angle of W in SO(2) with (|m|, |v|) ~ (cos, sin). That
/// form has four parameters and no singularity. Tangent: [rotation of U on the right, change of the
/// angle].
class Line3 {
 public:
  static constexpr int kDof = 4;  ///< degrees of freedom: size of the tangent
  /// [rotation of U on the right, change of the angle], rad.
  using Tangent = Eigen::Vector4d;
  /// [m, v], of unit length.
  using Coordinates = Eigen::Matrix<double, 6, 1>;

  /// The x axis.
  Line3();
  /// The line with the given orthonormal form, see above.
  Line3(const SO3& U, double angle) : U_(U), angle_(angle) {}
  /// The line through a point along a direction of any length.
  /// Throws ArgumentError if the direction is zero or anything is not finite.
  static Line3 from_direction(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

  /// Pluecker coordinates [m, v] of unit length and, in `J`, their derivative by the tangent.
  Coordinates coordinates(Eigen::Matrix<double, 6, 4>* J = nullptr) const;
  /// The direction v, of unit length.
  Eigen::Vector3d direction() const { return U_.matrix().col(1); }
  /// The point nearest to the origin.
  Eigen::Vector3d nearest_point() const;
  /// Distance of a point from the line, in the unit of the coordinates; never negative.
  double distance_to(const Eigen::Vector3d& point) const;
  /// The rotation of the orthonormal form: columns m/|m|, v/|v| and their cross product.
  const SO3& U() const { return U_; }
  /// The angle of the orthonormal form [rad]: |cot angle| is the distance from the origin.
  double angle() const { return angle_; }

  /// This [+] x: U * exp(x[0..2]) and angle + x[3].
  Line3 plus(const Tangent& x) const { return {U_.plus(x.head<3>()), angle_ + x[3]}; }
  /// The tangent x with other [+] x = this.
  Tangent minus(const Line3& other) const;

 private:
  SO3 U_;
  double angle_;
};

/// Pluecker coordinates in frame b of a line that is given in frame a:
/// v_b = R^T v_a, m_b = R^T (m_a - t x v_a) with T_a_b = (R, t). The Jacobians, if requested, are
/// the derivatives by T_a_b exp(xi) and by the tangent of the line:
///
///   d m_b / d xi = [hat(v_b), hat(m_b)],   d v_b / d xi = [0, hat(v_b)]
Line3::Coordinates transform_to(const SE3& T_a_b, const Line3& line_a,
                                Eigen::Matrix<double, 6, 6>* J_pose = nullptr,
                                Eigen::Matrix<double, 6, 4>* J_line = nullptr);

/// The line where two planes n^T p = d meet; nothing if they are parallel.
/// Planes count as parallel if the sine of the angle between them is below 1e-9. The normals may
/// have any length.
std::optional<Line3> meet(const Eigen::Vector3d& normal_a, double distance_a,
                          const Eigen::Vector3d& normal_b, double distance_b);

}  // namespace placegraph
