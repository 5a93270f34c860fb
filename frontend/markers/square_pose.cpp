#include <placegraph/frontend/markers/square_pose.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>

namespace placegraph {
namespace {

using Code = Outcome::Code;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Residual of a point and its derivative by the right tangent of T_ref_cam; false if the point is
/// behind the camera.
bool reproject(const Camera& camera, const SE3& T_cam_ref, const Eigen::Vector3d& point_ref,
               const Eigen::Vector2d& px, Eigen::Vector2d& r, Eigen::Matrix<double, 2, 6>* J) {
  const Eigen::Vector3d p_cam = T_cam_ref * point_ref;
  Eigen::Matrix<double, 2, 3> J_px_cam;
  const auto projected = camera.project(p_cam, J ? &J_px_cam : nullptr);
  if (!projected) return false;
  r = *projected - px;
  if (J) {
    // p_cam = exp(-xi) T^-1 p:  d p_cam / d xi = [-I, hat(p_cam)]
    J->leftCols<3>() = -J_px_cam;
    J->rightCols<3>() = J_px_cam * hat(p_cam);
  }
  return true;
}

/// Sum of squared errors; infinite if a corner or point is behind the camera.
double equations(const Camera& camera, const std::vector<SeenSquare>& squares,
                 const std::vector<SeenPoint>& points, const SE3& T_ref_cam, Matrix6d& H,
                 Vector6d& g) {
  const SE3 T_cam_ref = T_ref_cam.inverse();
  H.setZero();
  g.setZero();
  double chi2 = 0;
  for (const SeenSquare& square : squares) {
    Eigen::Matrix<double, 8, 1> r;
    Eigen::Matrix<double, 8, 6> J;
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector2d r_corner;
      Eigen::Matrix<double, 2, 6> J_corner;
      if (!reproject(camera, T_cam_ref, square.corners_ref[k], square.corners_px[k], r_corner,
                     &J_corner))
        return kInfinity;
      r.segment<2>(2 * k) = r_corner;
      J.middleRows<2>(2 * k) = J_corner;
    }
    const Eigen::Matrix<double, 6, 8> weighted = J.transpose() * square.information;
    H += weighted * J;
    g += weighted * r;
    chi2 += r.dot(square.information * r);
  }
  for (const SeenPoint& point : points) {
    Eigen::Vector2d r;
    Eigen::Matrix<double, 2, 6> J;
    if (!reproject(camera, T_cam_ref, point.point_ref, point.px, r, &J)) return kInfinity;
    H += J.transpose() * point.information * J;
    g += J.transpose() * point.information * r;
    chi2 += r.dot(point.information * r);
  }
  return chi2;
}

}  // namespace

double square_chi2(const Camera& camera, const SeenSquare& square, const SE3& T_ref_cam) {
  const SE3 T_cam_ref = T_ref_cam.inverse();
  Eigen::Matrix<double, 8, 1> r;
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector2d r_corner;
    if (!reproject(camera, T_cam_ref, square.corners_ref[k], square.corners_px[k], r_corner,
                   nullptr))
      return kInfinity;
    r.segment<2>(2 * k) = r_corner;
  }
  return r.dot(square.information * r);
}

double point_chi2(const Camera& camera, const SeenPoint& point, const SE3& T_ref_cam) {
  Eigen::Vector2d r;
  if (!reproject(camera, T_ref_cam.inverse(), point.point_ref, point.px, r, nullptr))
    return kInfinity;
  return r.dot(point.information * r);
}

namespace {

/// Free directions of a pose: all six, or all but tilts against a plane's normal.
Eigen::Matrix<double, 6, Eigen::Dynamic> free_directions(const SE3& T_ref_cam,
                                                         const Eigen::Vector3d* normal_ref) {
  if (!normal_ref) return Matrix6d::Identity();
  Eigen::Matrix<double, 6, Eigen::Dynamic> directions(6, 4);
  directions.setZero();
  directions.topLeftCorner<3, 3>().setIdentity();
  directions.block<3, 1>(3, 3) = T_ref_cam.rotation().inverse() * *normal_ref;
  return directions;
}

SquarePose refine(const Camera& camera, const std::vector<SeenSquare>& squares,
                  const std::vector<SeenPoint>& points, const SE3& T_ref_cam,
                  const Eigen::Vector3d* normal_ref) {
  SquarePose result;
  result.T_ref_cam = T_ref_cam;
  result.rows = static_cast<int>(8 * squares.size() + 2 * points.size());
  if (result.rows < 6) {
    result.outcome =
        Outcome::failure(Code::kTooFewData, std::to_string(result.rows) + " residuals");
    return result;
  }
  Matrix6d H, H_next;
  Vector6d g, g_next;
  result.chi2 = equations(camera, squares, points, T_ref_cam, H, g);
  if (!std::isfinite(result.chi2)) {
    result.outcome = Outcome::failure(Code::kNoConsensus, "a corner or point is behind the camera");
    return result;
  }
  // Iterations at most. Chosen.
  constexpr int kIterations = 60;
  double damping = 1e-2;  // short steps at first, so that they stay near the same minimum
  bool converged = false;
  for (int i = 0; i < kIterations && !converged; ++i) {
    const auto directions = free_directions(result.T_ref_cam, normal_ref);
    Eigen::MatrixXd damped = directions.transpose() * H * directions;
    damped.diagonal() *= 1 + damping;
    const Vector6d step = -directions * damped.ldlt().solve(directions.transpose() * g);
    const SE3 next = result.T_ref_cam.plus(step);
    const double chi2 =
        step.allFinite() ? equations(camera, squares, points, next, H_next, g_next) : kInfinity;
    // The decrease predicted by the linear model is negligible: converged.
    const double foreseen = -step.dot(g) - 0.5 * step.dot(H * step);
    if (chi2 <= result.chi2) {
      converged = foreseen < 1e-9 * (1 + chi2);
      result.T_ref_cam = next;
      result.chi2 = chi2;
      H = H_next;
      g = g_next;
      damping = std::max(1e-12, 0.1 * damping);
    } else {
      converged = foreseen < 1e-9 * (1 + result.chi2);
      damping *= 10;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(H);
  if (!(eigen.eigenvalues()[0] > 1e-12 * eigen.eigenvalues()[5])) {
    result.outcome = Outcome::failure(Code::kDegenerate, "a direction of the pose is undetermined");
    return result;
  }
  result.covariance = H.ldlt().solve(Matrix6d::Identity());
  result.outcome =
      converged ? Outcome::ok() : Outcome::failure(Code::kNotConverged, "no minimum reached");
  return result;
}

}  // namespace

SquarePose refine_square_pose(const Camera& camera, const std::vector<SeenSquare>& squares,
                              const std::vector<SeenPoint>& points, const SE3& T_ref_cam) {
  return refine(camera, squares, points, T_ref_cam, nullptr);
}

SquarePose find_planar_rival(const Camera& camera, const std::vector<SeenSquare>& squares,
                             const std::vector<SeenPoint>& points, const SE3& T_ref_cam,
                             const Eigen::Vector3d& centre_ref, const Eigen::Vector3d& normal_ref,
                             double apart_rad) {
  SquarePose result;
  // The camera is rotated about the centre to the other side of the normal.
  const Eigen::Vector3d view_direction = (centre_ref - T_ref_cam.translation()).normalized();
  const Eigen::Vector3d axis = view_direction.cross(normal_ref);
  const double tilt = std::atan2(axis.norm(), -view_direction.dot(normal_ref));
  if (!(2 * tilt > apart_rad)) {
    result.outcome = Outcome::failure(Code::kInconsistent, "the plane is seen frontally");
    return result;
  }
  const SO3 mirroring = SO3::exp(-2 * tilt * axis.normalized());
  const SE3 start(mirroring * T_ref_cam.rotation(),
                  Eigen::Vector3d(centre_ref + mirroring * (T_ref_cam.translation() - centre_ref)));
  result = refine(camera, squares, points, start, nullptr);
  const auto angle = [&](const SquarePose& pose) {
    return (pose.T_ref_cam.rotation().inverse() * T_ref_cam.rotation()).log().norm();
  };
  if (result.outcome && angle(result) > apart_rad) return result;
  return refine(camera, squares, points, start, &normal_ref);
}

bool same_minimum(const SquarePose& a, const SquarePose& b) {
  const Vector6d d = (a.T_ref_cam.inverse() * b.T_ref_cam).log();
  // A tenth of a standard deviation is one minimum. Chosen.
  constexpr double kSame = 0.1;
  return d.dot(a.covariance.ldlt().solve(d)) < kSame * kSame;
}

}  // namespace placegraph
