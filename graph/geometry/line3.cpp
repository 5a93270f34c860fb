#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/line3.h>

#include <cmath>

namespace placegraph {

Line3::Line3() : Line3(from_direction(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX())) {}

Line3 Line3::from_direction(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const double length = direction.norm();
  require(point.allFinite() && std::isfinite(length) && length > 0,
          "line: the direction must not be zero, and all must be finite");
  const Eigen::Vector3d v = direction / length;
  const Eigen::Vector3d m = point.cross(v);
  const double distance = m.norm();
  Eigen::Matrix3d U;
  U.col(0) = distance > 1e-12 ? Eigen::Vector3d(m / distance) : v.unitOrthogonal();
  U.col(0) = (U.col(0) - v.dot(U.col(0)) * v).normalized();
  U.col(1) = v;
  U.col(2) = U.col(0).cross(v);
  return {SO3::from_matrix(U), std::atan2(1.0, distance)};
}

Line3::Coordinates Line3::coordinates(Eigen::Matrix<double, 6, 4>* J) const {
  const Eigen::Matrix3d U = U_.matrix();
  const double c = std::cos(angle_), s = std::sin(angle_);
  Coordinates L;
  L << c * U.col(0), s * U.col(1);
  if (J) {
    // U exp(w) e_i ~ U (e_i + w x e_i)
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    J->topRows<3>() << zero, -c * U.col(2), c * U.col(1), -s * U.col(0);
    J->bottomRows<3>() << s * U.col(2), zero, -s * U.col(0), c * U.col(1);
  }
  return L;
}

Eigen::Vector3d Line3::nearest_point() const {
  return std::cos(angle_) / std::sin(angle_) * -U_.matrix().col(2);
}

double Line3::distance_to(const Eigen::Vector3d& point) const {
  return direction().cross(point - nearest_point()).norm();
}

Line3::Tangent Line3::minus(const Line3& other) const {
  Tangent x;
  x << (other.U_.inverse() * U_).log(), angle_ - other.angle_;
  return x;
}

Line3::Coordinates transform_to(const SE3& T_a_b, const Line3& line_a,
                                Eigen::Matrix<double, 6, 6>* J_pose,
                                Eigen::Matrix<double, 6, 4>* J_line) {
  const Eigen::Matrix3d R_b_a = T_a_b.rotation().matrix().transpose();
  const Line3::Coordinates L = line_a.coordinates(J_line);
  const Eigen::Vector3d& t = T_a_b.translation();
  Line3::Coordinates L_b;
  L_b.head<3>() = R_b_a * (L.head<3>() - t.cross(L.tail<3>()));
  L_b.tail<3>() = R_b_a * L.tail<3>();
  if (J_pose) {
    J_pose->setZero();
    J_pose->topLeftCorner<3, 3>() = hat(L_b.tail<3>());
    J_pose->topRightCorner<3, 3>() = hat(L_b.head<3>());
    J_pose->bottomRightCorner<3, 3>() = hat(L_b.tail<3>());
  }
  if (J_line) {
    const Eigen::Matrix<double, 3, 4> J_v = J_line->bottomRows<3>();
    J_line->topRows<3>() = (R_b_a * (J_line->topRows<3>() - hat(t) * J_v)).eval();
    J_line->bottomRows<3>() = R_b_a * J_v;
  }
  return L_b;
}

std::optional<Line3> meet(const Eigen::Vector3d& normal_a, double distance_a,
                          const Eigen::Vector3d& normal_b, double distance_b) {
  const Eigen::Vector3d v = normal_a.cross(normal_b);
  const double square = v.squaredNorm();
  if (!(square > 1e-18 * normal_a.squaredNorm() * normal_b.squaredNorm())) return std::nullopt;
  const Eigen::Vector3d point = (distance_a * normal_b - distance_b * normal_a).cross(v) / square;
  return Line3::from_direction(point, v);
}

}  // namespace placegraph
