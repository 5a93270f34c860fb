#include <placegraph/backend/window/prior_gauge.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

namespace placegraph {
namespace {

/// Smallest eigenvalue, scaled by the diagonal, of the prior's information about motions of the
/// whole window for which it constrains them.
constexpr double kGaugeFloor = 1e-8;

/// Derivative of the residuals by a common motion of all keyframes, planes and Manhattan frames.
/// The motion is a right tangent of the prior's first keyframe; the others' tangents are Ad(T_k^-1
/// T_first) times it.
Eigen::MatrixXd common_motion_of(const MarginalPrior& prior) {
  const SE3 T_map_first = prior.T_map_cam_lin.front();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(prior.J.rows(), 6);
  for (std::size_t k = 0; k < prior.keyframes.size(); ++k)
    J.noalias() +=
        prior.keyframe_columns(k) * (prior.T_map_cam_lin[k].inverse() * T_map_first).adjoint();
  for (std::size_t k = 0; k < prior.planes.size(); ++k) {
    // The plane moved by exp(xi) is the same plane seen from exp(-xi).
    Eigen::Matrix<double, 3, 6> J_plane;
    transform_to(SE3(), prior.plane_lin[k], &J_plane);
    J.noalias() -= prior.plane_columns(k) * J_plane * T_map_first.adjoint();
  }
  for (std::size_t k = 0; k < prior.manhattan_frames.size(); ++k)
    J.rightCols<3>().noalias() +=
        prior.manhattan_columns(k) *
        (prior.R_map_manhattan_lin[k].inverse() * T_map_first.rotation()).matrix();
  return J;
}

/// Change of the prior's residuals by a scaling of the whole window about a centre, per log(scale).
struct Growth {
  Eigen::VectorXd change;
  double size = 0;  ///< sum of the squared changes by the single variables
};

Growth growth_of(const MarginalPrior& prior, const Eigen::Vector3d& center_map) {
  Growth growth{Eigen::VectorXd::Zero(prior.J.rows())};
  const auto add = [&](const Eigen::VectorXd& share) {
    growth.change += share;
    growth.size += share.squaredNorm();
  };
  for (std::size_t k = 0; k < prior.keyframes.size(); ++k) {
    const SE3& T_map_cam = prior.T_map_cam_lin[k];
    add(prior.keyframe_columns(k).leftCols<3>() *
        (T_map_cam.rotation().inverse() * (T_map_cam.translation() - center_map)));
  }
  for (std::size_t k = 0; k < prior.planes.size(); ++k) {
    // The distance from the centre is scaled, the normal stays the same.
    Eigen::RowVector3d J_distance;
    prior.plane_lin[k].distance(&J_distance);
    add(prior.plane_columns(k) * J_distance.transpose() *
        (-prior.plane_lin[k].distance_to(center_map) / J_distance.squaredNorm()));
  }
  return growth;
}

}  // namespace

bool holds_pose(const MarginalPrior& prior) {
  if (prior.J.rows() < 6 || prior.keyframes.empty()) return false;
  Eigen::MatrixXd J = common_motion_of(prior);
  const Vector6d length = J.colwise().norm();
  if (!(length.minCoeff() > 0)) return false;
  J *= length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(Matrix6d(J.transpose() * J));
  return eigen.eigenvalues()[0] > kGaugeFloor;
}

bool holds_scale(const MarginalPrior& prior, const Eigen::Vector3d& center_map) {
  if (prior.empty()) return false;
  const Growth growth = growth_of(prior, center_map);
  return growth.change.squaredNorm() > kGaugeFloor * growth.size;
}

/// With J s the change by the scaling, the residuals are whitened by I + sigma^2 J s (J s)^T.
void relax_scale(MarginalPrior& prior, const Eigen::Vector3d& center_map, double sigma) {
  if (prior.empty()) return;
  const Eigen::VectorXd change = growth_of(prior, center_map).change;
  const double length = change.norm();
  if (!(length > 0)) return;
  const Eigen::VectorXd along = change / length;
  const double lost = 1 - 1 / std::hypot(1.0, sigma * length);
  prior.J -= lost * along * (along.transpose() * prior.J).eval();
  prior.e -= lost * along * along.dot(prior.e);
}

/// The residuals are projected on the complement of the changes by common motions.
void hold_first(MarginalPrior& prior) {
  const Eigen::MatrixXd common = common_motion_of(prior);
  // An orthonormal basis of the changes by common motions; unconstrained motions have none.
  const Eigen::VectorXd length = common.colwise().norm().transpose().cwiseMax(1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(common * length.cwiseInverse().asDiagonal());
  const Eigen::MatrixXd basis =
      qr.householderQ() * Eigen::MatrixXd::Identity(common.rows(), qr.rank());
  prior.J -= basis * (basis.transpose() * prior.J).eval();
  prior.e -= basis * (basis.transpose() * prior.e).eval();
  prior.J = prior.J.rightCols(prior.J.cols() - 6).eval();
  prior.keyframes.erase(prior.keyframes.begin());
  prior.T_map_cam_lin.erase(prior.T_map_cam_lin.begin());
}

/// The residuals are projected on the complement of the changes by that plane.
void forget_plane(MarginalPrior& prior, std::size_t k) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(prior.plane_columns(k));
  const Eigen::MatrixXd basis =
      qr.householderQ() * Eigen::MatrixXd::Identity(prior.J.rows(), qr.rank());
  prior.J -= basis * (basis.transpose() * prior.J).eval();
  prior.e -= basis * (basis.transpose() * prior.e).eval();
  const Eigen::Index begin =
      6 * static_cast<Eigen::Index>(prior.keyframes.size()) + 3 * static_cast<Eigen::Index>(k);
  const Eigen::Index after = prior.J.cols() - begin - 3;
  Eigen::MatrixXd J(prior.J.rows(), prior.J.cols() - 3);
  J << prior.J.leftCols(begin), prior.J.rightCols(after);
  prior.J = std::move(J);
  prior.planes.erase(prior.planes.begin() + static_cast<std::ptrdiff_t>(k));
  prior.plane_lin.erase(prior.plane_lin.begin() + static_cast<std::ptrdiff_t>(k));
}

}  // namespace placegraph
