#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/internal/window/distortion_evidence.h>
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <Eigen/Dense>
#include <cmath>

namespace placegraph {
namespace {

/// Normal equations of the keyframes' poses and, in the last column, the distortion.
class LensEquations {
 public:
  explicit LensEquations(const WindowState& state)
      : state_(state), kernel_{RobustKernel::Kind::kHuber, state.options.huber_px} {
    Eigen::Index column = 0;
    for (const auto& [id, T_map_cam] : state.keyframes) {
      column_[id] = column;
      column += 6;
    }
    H_ = Eigen::MatrixXd::Zero(column + 1, column + 1);
    b_ = Eigen::VectorXd::Zero(column + 1);
  }

  void add(const std::vector<const WindowObservation*>& observations,
           const Eigen::Vector3d& p_map) {
    const auto views = static_cast<Eigen::Index>(observations.size());
    J_.setZero(4 * views, 6 * views + 1);
    J_point_.setZero(4 * views, 3);
    r_.setZero(4 * views);
    columns_.clear();
    for (Eigen::Index k = 0; k < views; ++k) {
      const WindowObservation& o = *observations[static_cast<std::size_t>(k)];
      const SE3& T_map_cam = state_.keyframes.at(o.keyframe);
      const Eigen::Matrix3d R = T_map_cam.rotation().matrix();
      const Eigen::Vector3d p_cam = PointInCamera(R, T_map_cam.translation(), p_map).p_cam;
      const Reprojection reprojection = reprojection_of(state_.camera, o);
      add_rows(4 * k, 6 * k, R, p_cam, reprojection);
      const Eigen::Vector2d x = p_cam.head<2>() / p_cam.z();
      J_.block<2, 1>(4 * k, 6 * views) =
          weight_ * x.squaredNorm() *
          reprojection.whiten(Eigen::Vector2d(state_.camera.fx, state_.camera.fy).cwiseProduct(x));
      if (o.inverse_depth)
        add_rows(4 * k + 2, 6 * k, R, p_cam, InverseDepth(*o.inverse_depth, o.sigma_inverse_depth));
      for (int i = 0; i < 6; ++i) columns_.push_back(column_.at(o.keyframe) + i);
    }
    columns_.push_back(H_.cols() - 1);
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
  DistortionEvidence evidence() const {
    constexpr double kNothing = 1e-9;  // share of the largest eigenvalue
    const Eigen::Index poses = H_.cols() - 1;
    const Eigen::VectorXd unit =
        H_.diagonal().head(poses).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        unit.asDiagonal() * H_.topLeftCorner(poses, poses) * unit.asDiagonal());
    const Eigen::ArrayXd lambda = eigen.eigenvalues().array();
    const Eigen::VectorXd inverse =
        (lambda > kNothing * lambda[poses - 1]).select(lambda.inverse(), 0.0);
    const Eigen::VectorXd h =
        eigen.eigenvectors().transpose() * unit.cwiseProduct(H_.col(poses).head(poses));
    const Eigen::VectorXd b = eigen.eigenvectors().transpose() * unit.cwiseProduct(b_.head(poses));
    DistortionEvidence result;
    result.gradient = b_[poses] - h.dot(inverse.cwiseProduct(b));
    result.information = H_(poses, poses) - h.dot(inverse.cwiseProduct(h));
    return result;
  }

 private:
  template <class Measurement>
  void add_rows(Eigen::Index row, Eigen::Index column, const Eigen::Matrix3d& R_map_cam,
                const Eigen::Vector3d& p_cam, const Measurement& measurement) {
    const Eigen::Vector2d r = measurement.residual(p_cam);
    weight_ = std::sqrt(kernel_.evaluate(r.squaredNorm()).first);
    const Eigen::Matrix<double, 2, 3> A = weight_ * measurement.derivative(p_cam);
    r_.segment<2>(row) = weight_ * r;
    J_point_.middleRows<2>(row) = A * R_map_cam.transpose();
    J_.block<2, 3>(row, column) = -A;
    J_.block<2, 3>(row, column + 3) = A * hat(p_cam);
  }

  const WindowState& state_;
  RobustKernel kernel_;
  std::map<KeyframeId, Eigen::Index> column_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
  // Jacobian of one point: rows of its residuals, columns of the keyframes that observe it.
  Eigen::MatrixXd J_, J_point_;
  Eigen::VectorXd r_;
  std::vector<Eigen::Index> columns_;
  double weight_ = 1;  // square root of the weight of the last rows
};

}  // namespace

DistortionEvidence lens_evidence(const WindowState& state) {
  constexpr std::size_t kViews = 3;  // two views are consistent with nearly any distortion
  LensEquations equations(state);
  int residuals = 0;
  for (const auto& [id, landmark] : state.landmarks) {
    const auto observations = usable_observations(state, landmark);
    if (observations.size() < kViews) continue;
    equations.add(observations, landmark.p_map);
    residuals += static_cast<int>(2 * observations.size());
  }
  if (residuals == 0) return {};
  DistortionEvidence result = equations.evidence();
  result.residuals = residuals;
  return result;
}

}  // namespace placegraph
