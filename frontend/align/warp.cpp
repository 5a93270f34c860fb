#include <placegraph/frontend/align/warp.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The basis of sl(3) of Benhimane & Malis 2007: two translations, four of the linear part, two of
/// the vanishing line.
std::array<Matrix3d, 8> sl3_basis() {
  std::array<Matrix3d, 8> A;
  A.fill(Matrix3d::Zero());
  A[0](0, 2) = A[1](1, 2) = A[2](0, 1) = A[3](1, 0) = 1;
  A[4](0, 0) = 1, A[4](1, 1) = -1;
  A[5](1, 1) = -1, A[5](2, 2) = 1;
  A[6](2, 0) = A[7](2, 1) = 1;
  return A;
}

void put(PlanarWarp::Generators& all, int k, const Matrix3d& A) {
  all.col(k) << A.row(0).transpose(), A.row(1).transpose(), A.row(2).transpose();
}

/// The plane's axes in the camera: forward, n x forward, n.
SO3 plane_axes(const Vector3d& normal) {
  Vector3d forward = Vector3d::UnitZ() - normal.z() * normal;
  if (forward.norm() < 0.1) forward = Vector3d::UnitX() - normal.x() * normal;
  forward.normalize();
  Matrix3d R;
  R << forward, normal.cross(forward), normal;
  return SO3::from_matrix(R);
}

SE3 lift(const SE2& T) {
  return SE3(SO3::exp(Vector3d(0, 0, T.rotation().angle())),
             Vector3d(T.translation().x(), T.translation().y(), 0));
}

void check_plane(const Plane& plane) {
  require(plane.distance_m > 0 && std::abs(plane.normal.norm() - 1) < 1e-6,
          "planar warp: the plane needs a positive distance and a normal of unit length");
}

}  // namespace

Matrix3d sl3_exp(const Matrix3d& A) {
  int squarings = 0;
  double size = A.cwiseAbs().maxCoeff();
  for (; size > 0.1 && squarings < 60; size /= 2) ++squarings;
  const Matrix3d B = A / std::ldexp(1.0, squarings);
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int k = 1; k <= 12; ++k) {
    term = term * B / k;
    sum += term;
  }
  for (int i = 0; i < squarings; ++i) sum = (sum * sum).eval();
  return sum;
}

PlanarWarp PlanarWarp::homography(const Matrix3d& H_cur_ref, const Eigen::Vector2d& centre_px,
                                  double half_px) {
  require(half_px > 0, "planar warp: half_px must be positive");
  const double determinant = H_cur_ref.determinant();
  const double size = H_cur_ref.norm();
  require(H_cur_ref.allFinite() && std::abs(determinant) > 1e-15 * size * size * size,
          "planar warp: singular homography");
  PlanarWarp warp;
  warp.H_ = H_cur_ref / std::cbrt(determinant);
  warp.frame_ << half_px, 0, centre_px.x(), 0, half_px, centre_px.y(), 0, 0, 1;
  return warp;
}

PlanarWarp PlanarWarp::rigid_motion(const Matrix3d& K, const SE3& T_cur_ref,
                                    const Plane& plane_ref) {
  check_plane(plane_ref);
  PlanarWarp warp;
  warp.kind_ = Kind::kRigidMotion;
  warp.frame_ = K;
  warp.plane_ref_ = plane_ref;
  warp.rigid_ = T_cur_ref;
  warp.compose();
  return warp;
}

PlanarWarp PlanarWarp::planar_motion(const Matrix3d& K, const SE2& T_cur_ref,
                                     const Plane& plane_ref) {
  check_plane(plane_ref);
  PlanarWarp warp;
  warp.kind_ = Kind::kPlanarMotion;
  warp.frame_ = K;
  warp.plane_ref_ = plane_ref;
  warp.R_ref_plane_ = plane_axes(plane_ref.normal);
  warp.planar_ = T_cur_ref;
  warp.compose();
  return warp;
}

void PlanarWarp::compose() {
  if (kind_ == Kind::kPlanarMotion) {
    const SE3 R(R_ref_plane_, Vector3d::Zero());
    rigid_ = R * lift(planar_) * R.inverse();
  }
  H_ = homography_from_plane(frame_, rigid_, plane_ref_);
}

PlanarWarp PlanarWarp::plus(const Step& x) const {
  require(x.size() == dof(), "planar warp: a step of the wrong size");
  PlanarWarp moved = *this;
  if (kind_ == Kind::kHomography) {
    Matrix3d A = Matrix3d::Zero();
    const auto basis = sl3_basis();
    for (int k = 0; k < 8; ++k) A += x[k] * basis[k];
    moved.H_ = H_ * (frame_ * sl3_exp(A) * frame_.inverse());
    return moved;
  }
  if (kind_ == Kind::kRigidMotion)
    moved.rigid_ = rigid_.plus(x);
  else
    moved.planar_ = planar_.plus(x);
  moved.compose();
  return moved;
}

PlanarWarp::Generators PlanarWarp::generators() const {
  Generators all(9, dof());
  const Matrix3d frame_inverse = frame_.inverse();
  if (kind_ == Kind::kHomography) {
    const auto basis = sl3_basis();
    for (int k = 0; k < 8; ++k) put(all, k, frame_ * basis[k] * frame_inverse);
    return all;
  }
  // dH = K R ([w] + v n^T / d) K^-1 for T exp([v, w]).
  const Matrix3d KR = H_.inverse() * frame_ * rigid_.rotation().matrix();
  const Vector3d g = plane_ref_.normal / plane_ref_.distance_m;
  const auto direction = [&](const Vector3d& v, const Vector3d& w) -> Matrix3d {
    return KR * (hat(w) + v * g.transpose()) * frame_inverse;
  };
  if (kind_ == Kind::kRigidMotion) {
    for (int k = 0; k < 3; ++k) {
      put(all, k, direction(Vector3d::Unit(k), Vector3d::Zero()));
      put(all, k + 3, direction(Vector3d::Zero(), Vector3d::Unit(k)));
    }
    return all;
  }
  const Matrix3d axes = R_ref_plane_.matrix();
  put(all, 0, direction(axes.col(0), Vector3d::Zero()));
  put(all, 1, direction(axes.col(1), Vector3d::Zero()));
  put(all, 2, direction(Vector3d::Zero(), axes.col(2)));
  return all;
}

PlanarWarp PlanarWarp::at(const Matrix3d& H_cur_ref) const {
  const Eigen::Vector2d centre_px = frame_.topRightCorner<2, 1>();
  if (kind_ == Kind::kHomography) return homography(H_cur_ref, centre_px, frame_(0, 0));
  const SE3 unit = motion_from_homography(frame_, H_cur_ref, plane_ref_.normal);
  const SE3 T_cur_ref(unit.rotation(), plane_ref_.distance_m * unit.translation());
  if (kind_ == Kind::kRigidMotion) return rigid_motion(frame_, T_cur_ref, plane_ref_);
  const SE3 R(R_ref_plane_, Vector3d::Zero());
  const SE3 along = R.inverse() * T_cur_ref * R;
  const Matrix3d R_along = along.rotation().matrix();
  const double angle = std::atan2(R_along(1, 0) - R_along(0, 1), R_along(0, 0) + R_along(1, 1));
  return planar_motion(frame_, SE2(along.translation().x(), along.translation().y(), angle),
                       plane_ref_);
}

Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, PlanarWarp::kMaxDof> PlanarWarp::pixel_jacobian(
    const Eigen::Vector2d& px_ref) const {
  const Generators A = generators();
  const Vector3d p = px_ref.homogeneous(), q = H_ * p;
  Eigen::Matrix<double, 2, 3> by_q;
  by_q << 1 / q.z(), 0, -q.x() / (q.z() * q.z()), 0, 1 / q.z(), -q.y() / (q.z() * q.z());
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMaxDof> J(2, A.cols());
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    const Vector3d moved(A.col(k).segment<3>(0).dot(p), A.col(k).segment<3>(3).dot(p),
                         A.col(k).segment<3>(6).dot(p));
    J.col(k) = by_q * (H_ * moved);
  }
  return J;
}

std::optional<SE3> PlanarWarp::T_cur_ref() const {
  if (kind_ == Kind::kHomography) return std::nullopt;
  return rigid_;
}

std::optional<SE2> PlanarWarp::planar_T_cur_ref() const {
  if (kind_ != Kind::kPlanarMotion) return std::nullopt;
  return planar_;
}

std::optional<Eigen::Vector2d> map_pixel(const Matrix3d& H, const Eigen::Vector2d& px) {
  const Vector3d p = H * px.homogeneous();
  if (!(p.z() > 1e-9)) return std::nullopt;
  return Eigen::Vector2d(p.head<2>() / p.z());
}

}  // namespace placegraph
