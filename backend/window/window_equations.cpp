#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/window_equations.h>

#include <algorithm>

namespace placegraph {

template <class T>
Linearized<T> WindowEquations::linearize(const T& now, std::int64_t id,
                                         const std::vector<std::int64_t>& in_prior,
                                         const std::vector<T>& lin) const {
  Linearized<T> at;
  at.now = at.lin = now;
  const auto k = std::lower_bound(in_prior.begin(), in_prior.end(), id);
  if (first_estimates_ && k != in_prior.end() && *k == id) {
    at.lin = lin[static_cast<std::size_t>(k - in_prior.begin())];
    at.delta = VariableBlock<T>::minus(now, at.lin);
  }
  return at;
}

WindowEquations::WindowEquations(const WindowState& state, const WindowVariables& variables,
                                 bool first_estimates)
    : state_(state),
      first_estimates_(first_estimates),
      kernel_{RobustKernel::Kind::kHuber, state.options.huber_px} {
  for (const auto& [id, T_map_cam] : state.keyframes)
    keyframes_[id] = linearize(T_map_cam, id, state.prior.keyframes, state.prior.T_map_cam_lin);
  for (const auto& [id, plane_map] : state.planes)
    planes_[id] = linearize(plane_map, id, state.prior.planes, state.prior.plane_lin);
  for (const auto& [id, R_map_world] : state.worlds)
    worlds_[id] = linearize(R_map_world, id, state.prior.worlds, state.prior.R_map_world_lin);
  Eigen::Index column = 0;
  for (const WindowVariables::Variable& variable : variables.order) {
    column_of(variable) = column;
    column += WindowVariables::size(variable);
  }
  form.H = Eigen::MatrixXd::Zero(column, column);
  form.b = Eigen::VectorXd::Zero(column);
}

Eigen::Index& WindowEquations::column_of(const WindowVariables::Variable& variable) {
  switch (variable.kind) {
    case WindowVariables::Kind::kPlane:
      return planes_.at(variable.id).column;
    case WindowVariables::Kind::kWorld:
      return worlds_.at(variable.id).column;
    default:
      return keyframes_.at(variable.id).column;
  }
}

template <class Measurement>
void WindowEquations::add_measurement(const Linearized<SE3>& at, const Eigen::Vector3d& p_map,
                                      const Measurement& measurement) {
  const PointInCamera now(at.now.rotation().matrix(), at.now.translation(), p_map);
  const Eigen::Matrix3d R_map_cam = at.lin.rotation().matrix();
  const PointInCamera lin(R_map_cam, at.lin.translation(), p_map);
  if (!now.projectable() || !lin.projectable()) return;
  Eigen::Vector2d r = measurement.residual(now.p_cam);
  const Eigen::Matrix<double, 2, 3> A = measurement.derivative(lin.p_cam);
  const double w = kernel_.evaluate(r.squaredNorm()).first;
  const Eigen::Matrix<double, 2, 3> J_point = A * R_map_cam.transpose();
  Eigen::Matrix<double, 2, 6> J_pose;
  J_pose << -A, A * hat(lin.p_cam);
  if (at.column >= 0) r -= J_pose * at.delta;  // the residual at delta = 0
  point_.add(r, w, J_point, at.column, J_pose);
}

template <class F, class... T>
void WindowEquations::add_factor(const F& factor, bool robust, const Linearized<T>&... at) {
  typename F::Residual r, unused;
  typename F::Jacobians J;
  if (!factor.compute(at.now..., r, nullptr) || !factor.compute(at.lin..., unused, &J)) return;
  const double w = robust ? kernel_.evaluate(r.squaredNorm()).first : 1.0;
  std::vector<std::pair<Eigen::Index, Eigen::MatrixXd>> blocks;
  std::apply(
      [&](const auto&... J_k) {
        const auto take = [&](const auto& J_one, const auto& at_one) {
          if (at_one.column < 0) return;
          r -= J_one * at_one.delta;
          blocks.emplace_back(at_one.column, J_one);
        };
        (take(J_k, at), ...);
      },
      J);
  for (const auto& [i, J_i] : blocks) {
    form.b.segment(i, J_i.cols()) += w * J_i.transpose() * r;
    for (const auto& [j, J_j] : blocks)
      form.H.block(i, j, J_i.cols(), J_j.cols()) += w * J_i.transpose() * J_j;
  }
}

void WindowEquations::add_landmark(const WindowLandmark& landmark) {
  point_.clear();
  const auto usable = usable_observations(state_, landmark);
  for (const WindowObservation* o : usable) {
    const Linearized<SE3>& at = keyframes_.at(o->keyframe);
    add_measurement(at, landmark.p_map, reprojection_of(state_.camera, *o));
    if (o->inverse_depth)
      add_measurement(at, landmark.p_map, InverseDepth(*o->inverse_depth, o->sigma_inverse_depth));
  }
  if (landmark.on_plane && !usable.empty()) {
    const PointOnPlaneFactor factor(landmark.on_plane->sigma_m);
    const Linearized<Plane3>& at = planes_.at(landmark.on_plane->plane);
    PointOnPlaneFactor::Residual r, unused;
    PointOnPlaneFactor::Jacobians J;
    factor.compute(landmark.p_map, at.now, r, nullptr);
    factor.compute(landmark.p_map, at.lin, unused, &J);
    const double w = kernel_.evaluate(r.squaredNorm()).first;
    if (at.column >= 0) r -= std::get<1>(J) * at.delta;
    point_.add(r, w, std::get<0>(J), at.column, std::get<1>(J));
  }
  point_.eliminate(form);
}

void WindowEquations::add_line(const WindowLine& line) {
  if (!is_usable(line)) return;
  line_.clear();
  for (const LineObservation& o : line.observations) {
    const Linearized<SE3>& at = keyframes_.at(o.keyframe);
    for_factors(state_.camera, o, [&](const LineReprojectionFactor& factor) {
      LineReprojectionFactor::Residual r;
      LineReprojectionFactor::Jacobians J;
      factor.compute(at.now, line.line_map, at.lin, r, &J);
      const double w = kernel_.evaluate(r.squaredNorm()).first;
      if (at.column >= 0) r -= std::get<0>(J) * at.delta;
      line_.add(r, w, std::get<1>(J), at.column, std::get<0>(J));
    });
  }
  line_.eliminate(form);
}

void WindowEquations::add_distance(const DistanceObservation& d) {
  add_factor(DistanceFactor(d.distance_m, d.sigma_m), true, keyframes_.at(d.from),
             keyframes_.at(d.to));
}

void WindowEquations::add_height(const HeightObservation& h) {
  add_factor(HeightAbovePlaneFactor(h.height_m, h.sigma_m), true, keyframes_.at(h.keyframe),
             planes_.at(h.plane));
}

void WindowEquations::add_plane_observation(const PlaneObservation& o) {
  add_factor(PlaneObservationFactor(o.plane_cam, whitening_of(o)), true, keyframes_.at(o.keyframe),
             planes_.at(o.plane));
}

void WindowEquations::add_pose_prior(const PosePrior& prior) {
  add_factor(PosePriorFactor<SE3>(prior.T_map_cam, whitening(prior.information)), false,
             keyframes_.at(prior.keyframe));
}

void WindowEquations::add_world_observation(const WorldObservation& o) {
  add_factor(AbsoluteRotationFactor(o.R_cam_world, whitening_of(o)), true,
             keyframes_.at(o.keyframe), worlds_.at(o.world));
}

void WindowEquations::add_motion(const MotionObservation& m) {
  add_factor(RelativePoseFactor<SE3>(m.T_from_to, whitening(m.information)), false,
             keyframes_.at(m.from), keyframes_.at(m.to));
}

void WindowEquations::add_prior() {
  const MarginalPrior& prior = state_.prior;
  if (prior.empty()) return;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(prior.J.rows(), form.H.rows());
  Eigen::VectorXd e = prior.e;
  const auto add = [&](const auto& J_k, const auto& at, const auto& delta, const auto& J_delta) {
    if (at.column < 0) {
      e += J_k * at.delta;
    } else if (first_estimates_) {
      J.middleCols(at.column, delta.size()) = J_k;
    } else {
      J.middleCols(at.column, delta.size()) = J_k * J_delta(delta);
      e += J_k * delta;
    }
  };
  for (std::size_t k = 0; k < prior.keyframes.size(); ++k) {
    const Linearized<SE3>& at = keyframes_.at(prior.keyframes[k]);
    add(prior.keyframe_columns(k), at, VariableBlock<SE3>::minus(at.now, prior.T_map_cam_lin[k]),
        SE3::right_jacobian_inverse);
  }
  for (std::size_t k = 0; k < prior.planes.size(); ++k) {
    const Linearized<Plane3>& at = planes_.at(prior.planes[k]);
    add(prior.plane_columns(k), at, at.now.minus(prior.plane_lin[k]), SO3::right_jacobian_inverse);
  }
  for (std::size_t k = 0; k < prior.worlds.size(); ++k) {
    const Linearized<SO3>& at = worlds_.at(prior.worlds[k]);
    add(prior.world_columns(k), at, VariableBlock<SO3>::minus(at.now, prior.R_map_world_lin[k]),
        SO3::right_jacobian_inverse);
  }
  form.H.noalias() += J.transpose() * J;
  form.b.noalias() += J.transpose() * e;
}

}  // namespace placegraph
