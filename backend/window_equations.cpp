#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/marginalization.h>
#include <placegraph/backend/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace placegraph {
namespace {

/// Where a keyframe's factors are linearized: residuals at the estimate, Jacobians at the first
/// estimate if the keyframe is in the prior already (else at the estimate, and delta is zero).
struct LinearizationPoint {
  SE3 T_map_cam;
  SE3 T_map_cam_lin;
  Vector6d delta = Vector6d::Zero();  ///< log(T_map_cam_lin^-1 T_map_cam)
};

/// Gauss-Newton form of a window in the deviations delta of its keyframes from their linearization
/// points; landmarks are eliminated as they come. Robust kernels enter by their weights.
class WindowEquations {
 public:
  /// Six variables for each of `keyframes`; any other keyframe (the fixed one) is constant.
  WindowEquations(const WindowState& state, const std::vector<std::int64_t>& keyframes,
                  bool first_estimates)
      : state_(state), kernel_{RobustKernel::Kind::kHuber, state.options.huber_px} {
    for (const auto& [id, T_map_cam] : state.keyframes) points_[id] = {T_map_cam, T_map_cam, {}};
    for (auto& [id, point] : points_) point.delta.setZero();
    for (std::size_t k = 0; first_estimates && k < state.prior.keyframes.size(); ++k) {
      LinearizationPoint& point = points_.at(state.prior.keyframes[k]);
      point.T_map_cam_lin = state.prior.T_map_cam_lin[k];
      point.delta = (point.T_map_cam_lin.inverse() * point.T_map_cam).log();
    }
    for (const std::int64_t id : keyframes) {
      const auto next = static_cast<Eigen::Index>(column_.size());
      column_[id] = 6 * next;
    }
    const auto n = 6 * static_cast<Eigen::Index>(keyframes.size());
    form.H = Eigen::MatrixXd::Zero(n, n);
    form.b = Eigen::VectorXd::Zero(n);
  }

  void add_landmark(const WindowLandmark& landmark) {
    views_.clear();
    V_.setZero();
    v_.setZero();
    for (const WindowObservation* o : usable_observations(state_, landmark)) {
      View view;
      view.column = column_of(o->keyframe);
      const LinearizationPoint& at = points_.at(o->keyframe);
      add_measurement(view, at, landmark.p_map, Reprojection(state_.camera, o->px, o->sigma_px));
      if (o->inverse_depth)
        add_measurement(view, at, landmark.p_map,
                        InverseDepth(*o->inverse_depth, o->sigma_inverse_depth));
      if (view.column >= 0) views_.push_back(view);
    }
    eliminate_landmark();
  }

  void add_distance(const DistanceObservation& d) {
    const LinearizationPoint& a = points_.at(d.from);
    const LinearizationPoint& b = points_.at(d.to);
    const Distance distance(d.distance_m, d.sigma_m);
    const double r = distance.residual(a.T_map_cam, b.T_map_cam);
    Eigen::Matrix<double, 1, 6> J_a, J_b;
    distance.residual(a.T_map_cam_lin, b.T_map_cam_lin, &J_a, &J_b);
    const double w = kernel_.evaluate(r * r).first;
    const Eigen::Index i = column_of(d.from), j = column_of(d.to);
    double at_zero = r;
    if (i >= 0) at_zero -= J_a * a.delta;
    if (j >= 0) at_zero -= J_b * b.delta;
    if (i >= 0) {
      form.H.block<6, 6>(i, i) += w * J_a.transpose() * J_a;
      form.b.segment<6>(i) += w * J_a.transpose() * at_zero;
    }
    if (j >= 0) {
      form.H.block<6, 6>(j, j) += w * J_b.transpose() * J_b;
      form.b.segment<6>(j) += w * J_b.transpose() * at_zero;
    }
    if (i >= 0 && j >= 0) {
      form.H.block<6, 6>(i, j) += w * J_a.transpose() * J_b;
      form.H.block<6, 6>(j, i) += w * J_b.transpose() * J_a;
    }
  }

  /// With first estimates the prior is linear in delta as it stands; else it is relinearized.
  void add_prior(bool first_estimates) {
    const MarginalPrior& prior = state_.prior;
    if (prior.empty()) return;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(prior.J.rows(), form.H.rows());
    Eigen::VectorXd e = prior.e;
    for (std::size_t k = 0; k < prior.keyframes.size(); ++k) {
      const auto J_k = prior.J.middleCols<6>(6 * static_cast<Eigen::Index>(k));
      const Eigen::Index column = column_of(prior.keyframes[k]);
      if (column < 0) {
        e += J_k * points_.at(prior.keyframes[k]).delta;
        continue;
      }
      if (first_estimates) {
        J.middleCols<6>(column) = J_k;
        continue;
      }
      const SE3& T_map_cam = points_.at(prior.keyframes[k]).T_map_cam;
      const Vector6d delta = (prior.T_map_cam_lin[k].inverse() * T_map_cam).log();
      J.middleCols<6>(column) = J_k * SE3::right_jacobian_inverse(delta);
      e += J_k * delta;
    }
    form.H.noalias() += J.transpose() * J;
    form.b.noalias() += J.transpose() * e;
  }

  const SE3& linearization_point(std::int64_t keyframe) const {
    return points_.at(keyframe).T_map_cam_lin;
  }

  QuadraticForm form;

 private:
  /// One camera's share in the normal equations of a landmark.
  struct View {
    Eigen::Index column = -1;  ///< -1: constant
    Matrix6d H = Matrix6d::Zero();
    Eigen::Matrix<double, 6, 3> W = Eigen::Matrix<double, 6, 3>::Zero();
    Vector6d b = Vector6d::Zero();
  };

  Eigen::Index column_of(std::int64_t keyframe) const {
    const auto it = column_.find(keyframe);
    return it == column_.end() ? -1 : it->second;
  }

  template <class Measurement>
  void add_measurement(View& view, const LinearizationPoint& at, const Eigen::Vector3d& p_map,
                       const Measurement& measurement) {
    const PointInCamera now(at.T_map_cam.rotation().matrix(), at.T_map_cam.translation(), p_map);
    const Eigen::Matrix3d R_map_cam = at.T_map_cam_lin.rotation().matrix();
    const PointInCamera lin(R_map_cam, at.T_map_cam_lin.translation(), p_map);
    if (!now.projectable() || !lin.projectable()) return;
    Eigen::Vector2d r = measurement.residual(now.p_cam);
    const Eigen::Matrix<double, 2, 3> A = measurement.derivative(lin.p_cam);
    const double w = kernel_.evaluate(r.squaredNorm()).first;
    const Eigen::Matrix<double, 2, 3> J_point = A * R_map_cam.transpose();
    Eigen::Matrix<double, 2, 6> J_pose;
    J_pose << -A, A * hat(lin.p_cam);
    if (view.column >= 0) r -= J_pose * at.delta;  // the residual at delta = 0
    V_ += w * J_point.transpose() * J_point;
    v_ += w * J_point.transpose() * r;
    view.H += w * J_pose.transpose() * J_pose;
    view.W += w * J_pose.transpose() * J_point;
    view.b += w * J_pose.transpose() * r;
  }

  /// H -= W V^-1 W^T, b -= W V^-1 v over the landmark's cameras. Directions of the point that its
  /// views leave open carry nothing (floor of rounding size).
  void eliminate_landmark() {
    if (views_.empty()) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(V_);
    const Eigen::Vector3d lambda = eigen.eigenvalues();
    Eigen::Matrix3d B = Eigen::Matrix3d::Zero();  // V^-1 = B B^T
    for (int k = 0; k < 3; ++k)
      if (lambda[k] > 1e-13 * lambda[2])
        B.col(k) = eigen.eigenvectors().col(k) / std::sqrt(lambda[k]);
    const Eigen::Vector3d c = B.transpose() * v_;
    for (View& view : views_) {
      view.W = (view.W * B).eval();
      form.H.block<6, 6>(view.column, view.column) += view.H;
      form.b.segment<6>(view.column) += view.b - view.W * c;
    }
    for (const View& a : views_)
      for (const View& b : views_)
        form.H.block<6, 6>(a.column, b.column).noalias() -= a.W * b.W.transpose();
  }

  const WindowState& state_;
  RobustKernel kernel_;
  std::map<std::int64_t, LinearizationPoint> points_;
  std::map<std::int64_t, Eigen::Index> column_;
  std::vector<View> views_;
  Eigen::Matrix3d V_;
  Eigen::Vector3d v_;
};

bool sees(const WindowLandmark& landmark, std::int64_t keyframe) {
  return std::any_of(landmark.observations.begin(), landmark.observations.end(),
                     [&](const WindowObservation& o) { return o.keyframe == keyframe; });
}

/// The part of a form that carries anything, as the prior on those keyframes.
MarginalPrior make_prior(const QuadraticForm& form, const std::vector<std::int64_t>& keyframes,
                         const WindowEquations& equations) {
  MarginalPrior prior;
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const auto column = 6 * static_cast<Eigen::Index>(k);
    if (form.H.middleCols<6>(column).isZero(0)) continue;
    prior.keyframes.push_back(keyframes[k]);
    prior.T_map_cam_lin.push_back(equations.linearization_point(keyframes[k]));
    for (int i = 0; i < 6; ++i) columns.push_back(column + i);
  }
  if (columns.empty()) return prior;
  const SquareRootForm root = square_root({form.H(columns, columns), form.b(columns)});
  prior.J = root.J;
  prior.e = root.e;
  return prior;
}

/// Smallest eigenvalue, scaled by the diagonal, of the prior's information on motions of the whole
/// window below which it does not hold them.
constexpr double kGaugeFloor = 1e-8;

/// Whether the prior ties the window to the map: it resists every motion xi of all keyframes
/// together, exp(xi) T_map_cam, whose tangents are Ad(T_map_cam^-1) xi.
bool holds_pose(const MarginalPrior& prior) {
  if (prior.J.rows() < 6) return false;
  // About the first keyframe, so that far from the origin rotation and translation stay apart.
  const SE3 T_map_first = prior.T_map_cam_lin.front();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(prior.J.rows(), 6);
  for (std::size_t k = 0; k < prior.keyframes.size(); ++k)
    J.noalias() += prior.J.middleCols<6>(6 * static_cast<Eigen::Index>(k)) *
                   (prior.T_map_cam_lin[k].inverse() * T_map_first).adjoint();
  const Vector6d length = J.colwise().norm();
  if (!(length.minCoeff() > 0)) return false;
  J *= length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(Matrix6d(J.transpose() * J));
  return eigen.eigenvalues()[0] > kGaugeFloor;
}

/// Whether the prior resists a growth of all the window about `center_map`.
bool holds_scale(const MarginalPrior& prior, const Eigen::Vector3d& center_map) {
  if (prior.empty()) return false;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(prior.J.rows());
  double size = 0;
  for (std::size_t k = 0; k < prior.keyframes.size(); ++k) {
    const SE3& T_map_cam = prior.T_map_cam_lin[k];
    const auto J = prior.J.middleCols<3>(6 * static_cast<Eigen::Index>(k));
    const Eigen::VectorXd share =
        J * (T_map_cam.rotation().inverse() * (T_map_cam.translation() - center_map));
    change += share;
    size += share.squaredNorm();
  }
  return change.squaredNorm() > kGaugeFloor * size;
}

}  // namespace

void marginalize_keyframe(WindowState& state, std::int64_t leaving) {
  const std::int64_t newest = state.keyframes.rbegin()->first;
  // The leaving keyframe's variables come first; while it fixes the gauge it has none.
  std::vector<std::int64_t> variables;
  for (const auto& [id, T_map_cam] : state.keyframes)
    if (state.fixed != id) variables.push_back(id);
  WindowEquations equations(state, variables, true);

  bool metric = false;
  for (const auto& [id, landmark] : state.landmarks) {
    if (!sees(landmark, leaving) || sees(landmark, newest)) continue;
    equations.add_landmark(landmark);
    for (const WindowObservation& o : landmark.observations) metric |= o.inverse_depth.has_value();
  }
  if (const auto reference = scale_reference(state)) equations.add_distance(*reference);
  const auto involves = [&](const DistanceObservation& d) {
    return d.from == leaving || d.to == leaving;
  };
  for (const DistanceObservation& distance : state.distances)
    if (involves(distance)) {
      equations.add_distance(distance);
      metric = true;
    }
  equations.add_prior(true);

  const bool was_fixed = state.fixed == leaving;
  const QuadraticForm form = was_fixed ? equations.form : marginalize_first(equations.form, 6);
  if (!was_fixed) variables.erase(variables.begin());
  state.prior = make_prior(form, variables, equations);
  state.prior_is_metric |= metric;

  for (auto it = state.landmarks.begin(); it != state.landmarks.end();) {
    WindowLandmark& landmark = it->second;
    const bool ends = sees(landmark, leaving) && !sees(landmark, newest);
    std::erase_if(landmark.observations,
                  [&](const WindowObservation& o) { return o.keyframe == leaving; });
    it = ends || landmark.observations.empty() ? state.landmarks.erase(it) : std::next(it);
  }
  std::erase_if(state.distances, involves);
  state.keyframes.erase(leaving);
  state.fixed.reset();
  // Where everything the leaving keyframe saw is still in view, nothing went into the prior.
  const auto& [oldest, T_map_oldest] = *state.keyframes.begin();
  if (!holds_pose(state.prior)) state.fixed = oldest;
  state.prior_holds_scale = holds_scale(state.prior, T_map_oldest.translation());
}

Matrix6d relative_information(const WindowState& state, std::int64_t from, std::int64_t to) {
  // The other keyframes first, so that they can be marginalized; then `from`, then `to`.
  std::vector<std::int64_t> variables;
  for (const auto& [id, T_map_cam] : state.keyframes)
    if (id != from && id != to) variables.push_back(id);
  variables.push_back(from);
  variables.push_back(to);
  WindowEquations equations(state, variables, false);
  for (const auto& [id, landmark] : state.landmarks) equations.add_landmark(landmark);
  for (const DistanceObservation& distance : state.distances) equations.add_distance(distance);
  equations.add_prior(false);

  const Eigen::Index others = equations.form.H.rows() - 12;
  QuadraticForm joint = marginalize_first(equations.form, others);
  // From (xi_from, xi_to) to (xi_from, xi of T_from_to): xi_to = xi + Ad(T_from_to^-1) xi_from. A
  // window without a prior does not constrain xi_from then, all that is left of it is rounding.
  const SE3 T_from_to = state.keyframes.at(from).inverse() * state.keyframes.at(to);
  Eigen::Matrix<double, 12, 12> M = Eigen::Matrix<double, 12, 12>::Identity();
  M.bottomLeftCorner<6, 6>() = T_from_to.inverse().adjoint();
  const Eigen::VectorXd size_before =
      (M.cwiseAbs().transpose() * joint.H.cwiseAbs() * M.cwiseAbs()).diagonal().head<6>();
  joint.H = M.transpose() * joint.H * M;
  const QuadraticForm relative = marginalize_first(joint, 6, &size_before);
  return clamp_to_semidefinite(relative.H, 1e-9);
}

}  // namespace placegraph
