#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/internal/window/intrinsics_evidence.h>
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <Eigen/Dense>
#include <cmath>

namespace placegraph {
namespace {

constexpr Eigen::Index kParameters = IntrinsicsEvidence::kParameters;

/// Normal equations of the keyframes' poses and, in the last columns, the intrinsics.
class IntrinsicsEquations {
 public:
  IntrinsicsEquations(const WindowState& state, bool depths_measured)
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
  IntrinsicsEvidence evidence() const {
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
    IntrinsicsEvidence result;
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
    const double weight = add_rows(row, column, R, p_cam, reprojection);
    const PixelDerivative by_intrinsics = derivative(p_cam.head<2>() / p_cam.z());
    for (Eigen::Index i = 0; i < kParameters; ++i)
      J_.block<2, 1>(row, J_.cols() - kParameters + i) =
          weight * reprojection.whiten(by_intrinsics.col(i));
    if (o.inverse_depth) {
      const InverseDepth depth(*o.inverse_depth, o.sigma_inverse_depth);
      const double depth_weight = add_rows(row + 2, column, R, p_cam, depth);
      const double by_inverse = depth_weight * depth.inverse_sigma / p_cam.z();
      const auto column_of = [&](Eigen::Index i) { return J_.cols() - kParameters + i; };
      if (depths_measured_) {
        J_(row + 2, column_of(IntrinsicsEvidence::kDepthOffset)) = -by_inverse / p_cam.z();
      } else {  // a longer fx makes disparities larger
        J_(row + 2, column_of(IntrinsicsEvidence::kFocal)) = by_inverse;
        J_(row + 2, column_of(IntrinsicsEvidence::kAspect)) = 0.5 * by_inverse;
      }
    }
    for (int i = 0; i < 6; ++i) columns_.push_back(column_.at(o.keyframe) + i);
  }

  using PixelDerivative = Eigen::Matrix<double, 2, kParameters>;
  /// Derivative of the pixel of a point (x, y, 1) by the intrinsics.
  PixelDerivative derivative(const Eigen::Vector2d& x) const {
    const Eigen::Vector2d f(state_.camera.fx, state_.camera.fy);
    PixelDerivative J;
    J.col(IntrinsicsEvidence::kFocal) = f.cwiseProduct(x);
    J.col(IntrinsicsEvidence::kAspect) = 0.5 * Eigen::Vector2d(f[0] * x[0], -f[1] * x[1]);
    J.col(IntrinsicsEvidence::kPrincipalX) = Eigen::Vector2d(f[0], 0);
    J.col(IntrinsicsEvidence::kPrincipalY) = Eigen::Vector2d(0, f[1]);
    J.col(IntrinsicsEvidence::kRadial) = x.squaredNorm() * f.cwiseProduct(x);
    J.col(IntrinsicsEvidence::kDepthOffset).setZero();
    return J;
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

IntrinsicsEvidence intrinsics_evidence(const WindowState& state, bool depths_measured) {
  constexpr std::size_t kViews = 3;  // two views are consistent with nearly any intrinsics
  IntrinsicsEquations equations(state, depths_measured);
  int residuals = 0;
  for (const auto& [id, landmark] : state.landmarks) {
    const auto observations = usable_observations(state, landmark);
    if (observations.size() < kViews) continue;
    equations.add(observations, landmark.p_map);
    residuals += static_cast<int>(2 * observations.size());
  }
  if (residuals == 0) return {};
  IntrinsicsEvidence result = equations.evidence();
  result.residuals = residuals;
  return result;
}

}  // namespace placegraph
