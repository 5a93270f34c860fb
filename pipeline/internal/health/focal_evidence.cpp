#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/pipeline/internal/health/focal_evidence.h>

#include <Eigen/Dense>
#include <cmath>

namespace placegraph {
namespace {

constexpr Eigen::Index kParameters = 2;

/// Normal equations of the keyframes' poses and, in the last columns, the parameters of the lens.
class FocalEquations {
 public:
  FocalEquations(const WindowState& state, bool depths_measured)
      : state_(state),
        depths_measured_(depths_measured),
        kernel_{RobustKernel::Kind::kHuber, state.options.huber_px} {
    Eigen::Index column = 0;
    for (const auto& [id, T_map_cam] : state.keyframes) {
      column_[id] = column;
      column += 6;
    }
    H_ = Eigen::MatrixXd::Zero(column + kParameters, column + kParameters);
    b_ = Eigen::VectorXd::Zero(column + kParameters);
  }

  void add(const std::vector<const WindowObservation*>& observations,
           const Eigen::Vector3d& p_map) {
    const auto views = static_cast<Eigen::Index>(observations.size());
    J_.setZero(4 * views, 6 * views + kParameters);
    J_point_.setZero(4 * views, 3);
    r_.setZero(4 * views);
    columns_.clear();
    for (Eigen::Index k = 0; k < views; ++k)
      add_view(4 * k, 6 * k, *observations[static_cast<std::size_t>(k)], p_map);
    for (Eigen::Index i = kParameters; i > 0; --i) columns_.push_back(H_.cols() - i);
    // Projects on the complement of the effects of the point's position.
    const Eigen::HouseholderQR<Eigen::MatrixXd> point(J_point_);
    J_.applyOnTheLeft(point.householderQ().adjoint());
    r_.applyOnTheLeft(point.householderQ().adjoint());
    const auto J = J_.bottomRows(4 * views - 3);
    H_(columns_, columns_) += J.transpose() * J;
    b_(columns_) += J.transpose() * r_.tail(4 * views - 3);
  }

  /// The evidence with the poses eliminated; directions that no residual measures (the pose of the
  /// whole window, the scale of a monocular camera) are left out.
  FocalEvidence evidence() const {
    constexpr double kNothing = 1e-9;  // share of the largest eigenvalue
    const Eigen::Index poses = H_.cols() - kParameters;
    const Eigen::VectorXd unit =
        H_.diagonal().head(poses).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        unit.asDiagonal() * H_.topLeftCorner(poses, poses) * unit.asDiagonal());
    const Eigen::ArrayXd lambda = eigen.eigenvalues().array();
    const Eigen::VectorXd inverse =
        (lambda > kNothing * lambda[poses - 1]).select(lambda.inverse(), 0.0);
    const Eigen::MatrixXd coupling =
        eigen.eigenvectors().transpose() *
        (unit.asDiagonal() * H_.topRightCorner(poses, kParameters)).eval();
    const Eigen::VectorXd b = eigen.eigenvectors().transpose() * unit.cwiseProduct(b_.head(poses));
    FocalEvidence result;
    result.gradient = b_.tail(kParameters) - coupling.transpose() * inverse.cwiseProduct(b);
    result.information = H_.bottomRightCorner(kParameters, kParameters) -
                         coupling.transpose() * inverse.asDiagonal() * coupling;
    return result;
  }

 private:
  void add_view(Eigen::Index row, Eigen::Index column, const WindowObservation& o,
                const Eigen::Vector3d& p_map) {
    const SE3& T_map_cam = state_.keyframes.at(o.keyframe);
    const Eigen::Matrix3d R = T_map_cam.rotation().matrix();
    const Eigen::Vector3d p_cam = PointInCamera(R, T_map_cam.translation(), p_map).p_cam;
    const Reprojection reprojection = reprojection_of(state_.camera, o);
    const Eigen::Vector2d x = p_cam.head<2>() / p_cam.z();
    const Eigen::Vector2d by_focal =
        add_rows(row, column, R, p_cam, reprojection) *
        reprojection.whiten(Eigen::Vector2d(state_.camera.fx, state_.camera.fy).cwiseProduct(x));
    J_.block<2, 1>(row, J_.cols() - 2) = by_focal;
    J_.block<2, 1>(row, J_.cols() - 1) = x.squaredNorm() * by_focal;
    if (o.inverse_depth && depths_measured_)
      add_rows(row + 2, column, R, p_cam, InverseDepth(*o.inverse_depth, o.sigma_inverse_depth));
    for (int i = 0; i < 6; ++i) columns_.push_back(column_.at(o.keyframe) + i);
  }

  /// Adds the rows of a measurement for its pose and point; returns the root of their weight.
  template <class Measurement>
  double add_rows(Eigen::Index row, Eigen::Index column, const Eigen::Matrix3d& R_map_cam,
                  const Eigen::Vector3d& p_cam, const Measurement& measurement) {
    const Eigen::Vector2d r = measurement.residual(p_cam);
    const double weight = std::sqrt(kernel_.evaluate(r.squaredNorm()).first);
    const Eigen::Matrix<double, 2, 3> A = weight * measurement.derivative(p_cam);
    r_.segment<2>(row) = weight * r;
    J_point_.middleRows<2>(row) = A * R_map_cam.transpose();
    J_.block<2, 3>(row, column) = -A;
    J_.block<2, 3>(row, column + 3) = A * hat(p_cam);
    return weight;
  }

  const WindowState& state_;
  bool depths_measured_;
  RobustKernel kernel_;
  std::map<KeyframeId, Eigen::Index> column_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
  // Jacobian of one point: rows of its residuals, columns of the keyframes that observe it.
  Eigen::MatrixXd J_, J_point_;
  Eigen::VectorXd r_;
  std::vector<Eigen::Index> columns_;
};

}  // namespace

FocalEvidence focal_evidence(const WindowState& state, bool depths_measured) {
  constexpr std::size_t kViews = 3;
  FocalEquations equations(state, depths_measured);
  bool any = false;
  for (const auto& [id, landmark] : state.landmarks) {
    const auto observations = usable_observations(state, landmark);
    if (observations.size() < kViews) continue;
    equations.add(observations, landmark.p_map);
    any = true;
  }
  return any ? equations.evidence() : FocalEvidence();
}

}  // namespace placegraph
