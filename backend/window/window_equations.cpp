#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/window/window_equations.h>

#include <algorithm>

namespace placegraph {
namespace {

/// The first estimate of a variable, if the prior has one.
template <class Key, class T>
std::optional<Variable> first_estimate(const std::vector<Key>& in_prior, const std::vector<T>& lin,
                                       Key id) {
  const auto k = std::lower_bound(in_prior.begin(), in_prior.end(), id);
  if (k == in_prior.end() || *k != id) return std::nullopt;
  return lin[static_cast<std::size_t>(k - in_prior.begin())];
}

std::optional<Variable> first_estimate(const MarginalPrior& prior, const WindowVariable& variable) {
  switch (variable.kind) {
    case WindowVariable::Kind::kPlane:
      return first_estimate(prior.planes, prior.plane_lin, variable.plane());
    case WindowVariable::Kind::kManhattanFrame:
      return first_estimate(prior.manhattan_frames, prior.R_map_manhattan_lin,
                            variable.manhattan_frame());
    default:
      return first_estimate(prior.keyframes, prior.T_map_cam_lin, variable.keyframe());
  }
}

/// Whitened derivative of a measurement by the imaging errors; `J`: of pixel and inverse depth.
ImagingErrors::Rows2 whitened(const Reprojection& measurement, const ImagingErrors::Rows3& J) {
  ImagingErrors::Rows2 result;
  for (Eigen::Index i = 0; i < J.cols(); ++i)
    result.col(i) = measurement.whiten(J.col(i).head<2>());
  return result;
}

ImagingErrors::Rows2 whitened(const InverseDepth& measurement, const ImagingErrors::Rows3& J) {
  ImagingErrors::Rows2 result = ImagingErrors::Rows2::Zero();
  result.row(0) = measurement.inverse_sigma * J.row(2);
  return result;
}

}  // namespace

Eigen::Index columns_of(const std::vector<WindowVariable>& variables) {
  Eigen::Index n = 0;
  for (const WindowVariable& variable : variables) n += degrees_of_freedom(variable);
  return n;
}

WindowEquations::WindowEquations(const WindowState& state,
                                 const std::vector<WindowVariable>& variables, bool first_estimates)
    : state_(state),
      first_estimates_(first_estimates),
      kernel_{RobustKernel::Kind::kHuber, state.options.huber_px} {
  for (const WindowVariable& variable : variables_of(state)) {
    LinearizedVariable& at = variables_[variable];
    at.now = at.lin = value_of(state, variable);
    at.delta.setZero(degrees_of_freedom(variable));
    if (!first_estimates) continue;
    if (const auto first = first_estimate(state.prior, variable)) {
      at.lin = *first;
      at.delta = minus(at.now, at.lin);
    }
  }
  Eigen::Index column = 0;
  for (const WindowVariable& variable : variables) {
    variables_.at(variable).column = column;
    column += degrees_of_freedom(variable);
  }
  form.H = Eigen::MatrixXd::Zero(column, column);
  form.b = Eigen::VectorXd::Zero(column);
}

template <class Measurement>
void WindowEquations::add_measurement(const LinearizedVariable& at, const Eigen::Vector3d& p_map,
                                      const Measurement& measurement,
                                      const std::optional<Vector6d>& velocity) {
  const SE3 &T_now = std::get<SE3>(at.now), &T_lin = std::get<SE3>(at.lin);
  const PointInCamera now(T_now.rotation().matrix(), T_now.translation(), p_map);
  const Eigen::Matrix3d R_map_cam = T_lin.rotation().matrix();
  const PointInCamera lin(R_map_cam, T_lin.translation(), p_map);
  if (!now.projectable() || !lin.projectable()) return;
  Eigen::Vector2d r = measurement.residual(now.p_cam);
  const Eigen::Matrix<double, 2, 3> A = measurement.derivative(lin.p_cam);
  const double w = kernel_.evaluate(r.squaredNorm()).first;
  const Eigen::Matrix<double, 2, 3> J_point = A * R_map_cam.transpose();
  Eigen::Matrix<double, 2, 6> J_pose;
  J_pose << -A, A * hat(lin.p_cam);
  if (at.column >= 0) r -= J_pose * Vector6d(at.delta);  // the residual at delta = 0
  point_.add(r, w, J_point, at.column, J_pose);
  if (!images) return;
  point_.add_errors(
      r, w, J_point, at.column, J_pose,
      whitened(measurement, derivative_by_imaging_errors(state_.camera, lin.p_cam, velocity,
                                                         state_.options.depths_from_disparities)));
}

void WindowEquations::add_landmark(const WindowLandmark& landmark) {
  point_.clear();
  const auto usable = usable_observations(state_, landmark);
  for (const WindowObservation* o : usable) {
    const LinearizedVariable& at = variables_.at(keyframe_variable(o->keyframe));
    const auto velocity = images ? velocity_of(state_, o->keyframe) : std::nullopt;
    add_measurement(at, landmark.p_map, reprojection_of(state_.camera, *o), velocity);
    if (o->inverse_depth)
      add_measurement(at, landmark.p_map, InverseDepth(*o->inverse_depth, o->sigma_inverse_depth),
                      velocity);
  }
  if (landmark.on_plane && !usable.empty()) {
    const PointOnPlaneFactor factor(landmark.on_plane->sigma_m);
    const LinearizedVariable& at = variables_.at(plane_variable(landmark.on_plane->plane));
    PointOnPlaneFactor::Residual r, unused;
    PointOnPlaneFactor::Jacobians J;
    factor.compute(landmark.p_map, std::get<Plane3>(at.now), r, nullptr);
    factor.compute(landmark.p_map, std::get<Plane3>(at.lin), unused, &J);
    const double w = kernel_.evaluate(r.squaredNorm()).first;
    if (at.column >= 0) r -= std::get<1>(J) * Eigen::Vector3d(at.delta);
    point_.add(r, w, std::get<0>(J), at.column, std::get<1>(J));
  }
  point_.eliminate(form, sums());
}

void WindowEquations::add_line(const WindowLine& line) {
  if (!is_usable(line)) return;
  line_.clear();
  for (const LineObservation& o : line.observations) {
    const LinearizedVariable& at = variables_.at(keyframe_variable(o.keyframe));
    for_factors(state_.camera, o, [&](const LineReprojectionFactor& factor) {
      LineReprojectionFactor::Residual r;
      LineReprojectionFactor::Jacobians J;
      factor.compute(std::get<SE3>(at.now), line.line_map, std::get<SE3>(at.lin), r, &J);
      const double w = kernel_.evaluate(r.squaredNorm()).first;
      if (at.column >= 0) r -= std::get<0>(J) * Vector6d(at.delta);
      line_.add(r, w, std::get<1>(J), at.column, std::get<0>(J));
    });
  }
  line_.eliminate(form, sums());
}

void WindowEquations::add(const WindowFactor& f) {
  const std::size_t variables = f.variables.size();
  std::vector<const LinearizedVariable*> at;
  std::vector<const Variable*> now, lin;
  std::vector<Eigen::MatrixXd> J;
  for (const WindowVariable& variable : f.variables) {
    at.push_back(&variables_.at(variable));
    now.push_back(&at.back()->now);
    lin.push_back(&at.back()->lin);
    J.emplace_back(f.factor->residual_size(), degrees_of_freedom(variable));
  }
  Eigen::VectorXd r(f.factor->residual_size()), unused(f.factor->residual_size());
  if (!f.factor->evaluate(now, r, {}) || !f.factor->evaluate(lin, unused, J)) return;
  const double w = f.robust ? kernel_.evaluate(r.squaredNorm()).first : 1.0;
  for (std::size_t i = 0; i < variables; ++i)
    if (at[i]->column >= 0) r -= J[i] * at[i]->delta;  // the residual at delta = 0
  for (std::size_t i = 0; i < variables; ++i) {
    if (at[i]->column < 0) continue;
    form.b.segment(at[i]->column, J[i].cols()) += w * J[i].transpose() * r;
    for (std::size_t j = 0; j < variables; ++j)
      if (at[j]->column >= 0)
        form.H.block(at[i]->column, at[j]->column, J[i].cols(), J[j].cols()) +=
            w * J[i].transpose() * J[j];
  }
}

void WindowEquations::add_prior() {
  const MarginalPrior& prior = state_.prior;
  if (prior.empty()) return;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(prior.J.rows(), form.H.rows());
  Eigen::VectorXd e = prior.e;
  const auto add = [&](const WindowVariable& variable, const auto& J_k, const auto& lin,
                       const auto& J_delta) {
    using T = std::decay_t<decltype(lin)>;
    const LinearizedVariable& at = variables_.at(variable);
    const typename VariableBlock<T>::Tangent delta =
        VariableBlock<T>::minus(std::get<T>(at.now), lin);
    if (at.column < 0) {
      // Constant and in the prior: its deviation since then stays in the residual.
      e += J_k * typename VariableBlock<T>::Tangent(at.delta);
    } else if (first_estimates_) {
      J.middleCols(at.column, delta.size()) = J_k;
    } else {
      J.middleCols(at.column, delta.size()) = J_k * J_delta(delta);
      e += J_k * delta;
    }
  };
  for (std::size_t k = 0; k < prior.keyframes.size(); ++k)
    add(keyframe_variable(prior.keyframes[k]), prior.keyframe_columns(k), prior.T_map_cam_lin[k],
        SE3::right_jacobian_inverse);
  for (std::size_t k = 0; k < prior.planes.size(); ++k)
    add(plane_variable(prior.planes[k]), prior.plane_columns(k), prior.plane_lin[k],
        SO3::right_jacobian_inverse);
  for (std::size_t k = 0; k < prior.manhattan_frames.size(); ++k)
    add(manhattan_variable(prior.manhattan_frames[k]), prior.manhattan_columns(k),
        prior.R_map_manhattan_lin[k], SO3::right_jacobian_inverse);
  form.H.noalias() += J.transpose() * J;
  form.b.noalias() += J.transpose() * e;
}

}  // namespace placegraph
