#pragma once
#include <placegraph/backend/evidence/nuisance_evidence.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

namespace placegraph {

/// Normal equations of the keyframes' poses and, in the last columns, nuisance parameters that all
/// observations share: errors of the calibration or of times.
class NuisanceEquations {
 public:
  /// Rows u, v [px] and inverse depth [1/m]; one column a parameter.
  using Derivative = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  /// Sets (it begins as 0) how the predicted observation of a point at `p_cam` changes.
  using DerivativeOf = std::function<void(const WindowObservation& observation,
                                          const Eigen::Vector3d& p_cam, Derivative& derivative)>;

  /// `state` must outlive the object.
  NuisanceEquations(const WindowState& state, Eigen::Index parameters, DerivativeOf derivative_of)
      : state_(state),
        parameters_(parameters),
        derivative_of_(std::move(derivative_of)),
        kernel_{RobustKernel::Kind::kHuber, state.options.huber_px} {
    Eigen::Index column = 0;
    for (const auto& [id, T_map_cam] : state.keyframes) {
      column_[id] = column;
      column += 6;
    }
    H_ = Eigen::MatrixXd::Zero(column + parameters, column + parameters);
    b_ = Eigen::VectorXd::Zero(column + parameters);
  }

  /// Adds the observations of a point.
  void add(const std::vector<const WindowObservation*>& observations,
           const Eigen::Vector3d& p_map) {
    const auto views = static_cast<Eigen::Index>(observations.size());
    J_.setZero(4 * views, 6 * views + parameters_);
    J_point_.setZero(4 * views, 3);
    r_.setZero(4 * views);
    columns_.clear();
    for (Eigen::Index k = 0; k < views; ++k)
      add_view(4 * k, 6 * k, *observations[static_cast<std::size_t>(k)], p_map);
    for (Eigen::Index i = parameters_; i > 0; --i) columns_.push_back(H_.cols() - i);
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
  NuisanceEvidence evidence() const {
    const auto [unit, eigenvectors, inverse, coupling] = eliminated();
    const Eigen::VectorXd b = eigenvectors.transpose() * unit.cwiseProduct(b_.head(poses()));
    return {b_.tail(parameters_) - coupling.transpose() * inverse.cwiseProduct(b),
            H_.bottomRightCorner(parameters_, parameters_) -
                coupling.transpose() * inverse.asDiagonal() * coupling};
  }

  /// Derivative of the estimated poses, in the right tangent of each in the order of the keyframes,
  /// by the parameters; zero in the directions that no residual measures.
  Eigen::MatrixXd poses_by_parameters() const {
    const auto [unit, eigenvectors, inverse, coupling] = eliminated();
    return -(unit.asDiagonal() * (eigenvectors * (inverse.asDiagonal() * coupling).eval()).eval());
  }

 private:
  /// H_pp = diag(1 / unit) V diag(1 / inverse) V^T diag(1 / unit) of the poses.
  struct Eliminated {
    Eigen::VectorXd unit;
    Eigen::MatrixXd eigenvectors;
    Eigen::VectorXd inverse;   // zero where nothing is measured
    Eigen::MatrixXd coupling;  // with the parameters
  };
  Eliminated eliminated() const {
    constexpr double kNothing = 1e-9;  // share of the largest eigenvalue
    Eliminated result;
    result.unit = H_.diagonal().head(poses()).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const auto unit = result.unit.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        unit * H_.topLeftCorner(poses(), poses()) * unit);
    const Eigen::ArrayXd lambda = eigen.eigenvalues().array();
    result.eigenvectors = eigen.eigenvectors();
    result.inverse = (lambda > kNothing * lambda[poses() - 1]).select(lambda.inverse(), 0.0);
    result.coupling =
        result.eigenvectors.transpose() * (unit * H_.topRightCorner(poses(), parameters_)).eval();
    return result;
  }
  Eigen::Index poses() const { return H_.cols() - parameters_; }

  void add_view(Eigen::Index row, Eigen::Index column, const WindowObservation& o,
                const Eigen::Vector3d& p_map) {
    const SE3& T_map_cam = state_.keyframes.at(o.keyframe);
    const Eigen::Matrix3d R = T_map_cam.rotation().matrix();
    const Eigen::Vector3d p_cam = PointInCamera(R, T_map_cam.translation(), p_map).p_cam;
    derivative_.setZero(3, parameters_);
    derivative_of_(o, p_cam, derivative_);
    const Reprojection reprojection = reprojection_of(state_.camera, o);
    const double weight = add_rows(row, column, R, p_cam, reprojection);
    for (Eigen::Index i = 0; i < parameters_; ++i)
      J_.block<2, 1>(row, J_.cols() - parameters_ + i) =
          weight * reprojection.whiten(Eigen::Vector2d(derivative_.col(i).head<2>()));
    if (o.inverse_depth) {
      const InverseDepth depth(*o.inverse_depth, o.sigma_inverse_depth);
      const double depth_weight = add_rows(row + 2, column, R, p_cam, depth);
      J_.block(row + 2, J_.cols() - parameters_, 1, parameters_) =
          depth_weight * depth.inverse_sigma * derivative_.row(2);
    }
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
  Eigen::Index parameters_;
  DerivativeOf derivative_of_;
  RobustKernel kernel_;
  std::map<KeyframeId, Eigen::Index> column_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
  // Jacobian of one point: rows of its residuals, columns of the keyframes that observe it.
  Eigen::MatrixXd J_, J_point_;
  Eigen::VectorXd r_;
  Derivative derivative_;
  std::vector<Eigen::Index> columns_;
};

}  // namespace placegraph
