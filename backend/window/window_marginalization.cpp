#include <placegraph/backend/window/window_equations.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace placegraph {
namespace {

using Kind = WindowVariables::Kind;

template <class Landmark>
bool sees(const Landmark& landmark, std::int64_t keyframe) {
  return std::any_of(landmark.observations.begin(), landmark.observations.end(),
                     [&](const auto& o) { return o.keyframe == keyframe; });
}

/// The part of a form that carries anything, as the prior on those variables.
MarginalPrior make_prior(const QuadraticForm& form, const WindowVariables& variables,
                         const WindowEquations& equations) {
  MarginalPrior prior;
  std::map<Kind, std::vector<Eigen::Index>> columns_of;
  Eigen::Index column = 0;
  for (const auto& variable : variables.order) {
    const int size = WindowVariables::size(variable);
    if (!form.H.middleCols(column, size).isZero(0)) {
      if (variable.kind == Kind::kPlane) {
        prior.planes.push_back(variable.id);
        prior.plane_lin.push_back(equations.plane_lin(variable.id));
      } else if (variable.kind == Kind::kWorld) {
        prior.worlds.push_back(variable.id);
        prior.R_map_world_lin.push_back(equations.world_lin(variable.id));
      } else {
        prior.keyframes.push_back(variable.id);
        prior.T_map_cam_lin.push_back(equations.keyframe_lin(variable.id));
      }
      for (int i = 0; i < size; ++i) columns_of[variable.kind].push_back(column + i);
    }
    column += size;
  }
  std::vector<Eigen::Index> columns;
  for (const Kind kind : {Kind::kKeyframe, Kind::kPlane, Kind::kWorld})
    columns.insert(columns.end(), columns_of[kind].begin(), columns_of[kind].end());
  if (columns.empty()) return prior;
  const SquareRootForm root = square_root({form.H(columns, columns), form.b(columns)});
  prior.J = root.J;
  prior.e = root.e;
  return prior;
}

/// Smallest eigenvalue, scaled by the diagonal, of the prior's information on motions of the whole
/// window below which it does not hold them.
constexpr double kGaugeFloor = 1e-8;

/// What a motion of all keyframes, planes and worlds together, by a right tangent of the prior's
/// first keyframe, does to the residuals: the others' tangents are Ad(T_k^-1 T_first) times it.
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
  for (std::size_t k = 0; k < prior.worlds.size(); ++k)
    J.rightCols<3>().noalias() +=
        prior.world_columns(k) *
        (prior.R_map_world_lin[k].inverse() * T_map_first.rotation()).matrix();
  return J;
}

/// Whether the prior ties the window to the map: it resists every motion of all of it.
bool holds_pose(const MarginalPrior& prior) {
  if (prior.J.rows() < 6 || prior.keyframes.empty()) return false;
  Eigen::MatrixXd J = common_motion_of(prior);
  const Vector6d length = J.colwise().norm();
  if (!(length.minCoeff() > 0)) return false;
  J *= length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(Matrix6d(J.transpose() * J));
  return eigen.eigenvalues()[0] > kGaugeFloor;
}

/// What a growth of all the window about a centre, by a logarithm of one, does to the residuals of
/// the prior.
struct Growth {
  Eigen::VectorXd change;
  double size = 0;  ///< sum of the squares of what the variables bring, one by one
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
    // The distance from the centre grows, the normal stays.
    Eigen::RowVector3d J_distance;
    prior.plane_lin[k].distance(&J_distance);
    add(prior.plane_columns(k) * J_distance.transpose() *
        (-prior.plane_lin[k].distance_to(center_map) / J_distance.squaredNorm()));
  }
  return growth;
}

/// Whether the prior resists a growth of all the window about `center_map`.
bool holds_scale(const MarginalPrior& prior, const Eigen::Vector3d& center_map) {
  if (prior.empty()) return false;
  const Growth growth = growth_of(prior, center_map);
  return growth.change.squaredNorm() > kGaugeFloor * growth.size;
}

/// The prior of a window that has grown about `center_map` by a random logarithm of deviation
/// `sigma`: J s being what the growth does, the residuals are whitened by I + sigma^2 J s (J s)^T.
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

/// The prior of the window relative to its first keyframe, which has no columns any more: where all
/// of it lies together is integrated out, that is, the residuals are projected on the complement of
/// what common motions do.
void hold_first(MarginalPrior& prior) {
  const Eigen::MatrixXd common = common_motion_of(prior);
  // An orthonormal basis of the common motions' part; what is not resisted has none.
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

/// Planes that nothing in the window but what leaves with a keyframe speaks of, and that nobody
/// wants kept.
std::vector<std::int64_t> leaving_planes(const WindowState& state, std::int64_t leaving,
                                         std::int64_t newest) {
  std::set<std::int64_t> touched(state.prior.planes.begin(), state.prior.planes.end()), staying;
  staying = state.kept_planes;
  const auto of = [&](const auto& o) {
    (o.keyframe == leaving ? touched : staying).insert(o.plane);
  };
  std::for_each(state.heights.begin(), state.heights.end(), of);
  std::for_each(state.plane_observations.begin(), state.plane_observations.end(), of);
  for (const auto& [id, landmark] : state.landmarks) {
    if (!landmark.on_plane) continue;
    const bool ends = sees(landmark, leaving) && !sees(landmark, newest);
    (ends ? touched : staying).insert(landmark.on_plane->plane);
  }
  std::vector<std::int64_t> planes;
  std::set_difference(touched.begin(), touched.end(), staying.begin(), staying.end(),
                      std::back_inserter(planes));
  return planes;
}

/// Worlds that nothing in the window but what leaves with a keyframe speaks of, and that nobody
/// wants kept.
std::vector<std::int64_t> leaving_worlds(const WindowState& state, std::int64_t leaving) {
  std::set<std::int64_t> touched(state.prior.worlds.begin(), state.prior.worlds.end()),
      staying(state.kept_worlds);
  for (const WorldObservation& o : state.world_observations)
    (o.keyframe == leaving ? touched : staying).insert(o.world);
  std::vector<std::int64_t> worlds;
  std::set_difference(touched.begin(), touched.end(), staying.begin(), staying.end(),
                      std::back_inserter(worlds));
  return worlds;
}

/// Takes out of the window what has gone into the prior with a keyframe.
void erase_keyframe(WindowState& state, std::int64_t leaving, std::int64_t newest,
                    const std::vector<std::int64_t>& planes,
                    const std::vector<std::int64_t>& worlds) {
  const auto erase_from = [&](auto& landmarks) {
    for (auto it = landmarks.begin(); it != landmarks.end();) {
      auto& landmark = it->second;
      const bool ends = sees(landmark, leaving) && !sees(landmark, newest);
      std::erase_if(landmark.observations, [&](const auto& o) { return o.keyframe == leaving; });
      it = ends || landmark.observations.empty() ? landmarks.erase(it) : std::next(it);
    }
  };
  erase_from(state.landmarks);
  erase_from(state.lines);
  std::erase_if(state.distances,
                [&](const DistanceObservation& d) { return d.from == leaving || d.to == leaving; });
  std::erase_if(state.motions,
                [&](const MotionObservation& m) { return m.from == leaving || m.to == leaving; });
  const auto of_leaving = [&](const auto& o) { return o.keyframe == leaving; };
  std::erase_if(state.heights, of_leaving);
  std::erase_if(state.plane_observations, of_leaving);
  std::erase_if(state.pose_priors, of_leaving);
  std::erase_if(state.world_observations, of_leaving);
  for (const std::int64_t world : worlds) {
    state.worlds.erase(world);
    if (state.held_world == world) state.held_world.reset();
  }
  for (const std::int64_t plane : planes) state.planes.erase(plane);
  state.kept.erase(leaving);
  state.keyframes.erase(leaving);
}

}  // namespace

void marginalize_keyframe(WindowState& state, std::int64_t leaving) {
  const std::int64_t newest = state.keyframes.rbegin()->first;
  const std::vector<std::int64_t> planes = leaving_planes(state, leaving, newest);
  const std::vector<std::int64_t> worlds = leaving_worlds(state, leaving);
  // What leaves comes first; while the keyframe fixes the gauge it has no variables.
  const bool was_fixed = state.fixed == leaving;
  WindowVariables gone, variables;
  if (!was_fixed) gone.order.push_back({Kind::kKeyframe, leaving});
  for (const std::int64_t plane : planes) gone.order.push_back({Kind::kPlane, plane});
  for (const std::int64_t world : worlds) gone.order.push_back({Kind::kWorld, world});
  for (const auto& [id, T_map_cam] : state.keyframes)
    if (id != leaving && state.fixed != id) variables.order.push_back({Kind::kKeyframe, id});
  for (const auto& [id, plane_map] : state.planes)
    if (!std::binary_search(planes.begin(), planes.end(), id))
      variables.order.push_back({Kind::kPlane, id});
  for (const auto& [id, R_map_world] : state.worlds)
    if (!std::binary_search(worlds.begin(), worlds.end(), id))
      variables.order.push_back({Kind::kWorld, id});
  WindowVariables all = gone;
  all.order.insert(all.order.end(), variables.order.begin(), variables.order.end());
  WindowEquations equations(state, all, true);

  bool metric = false;
  for (const auto& [id, landmark] : state.landmarks) {
    if (!sees(landmark, leaving) || sees(landmark, newest)) continue;
    equations.add_landmark(landmark);
    for (const WindowObservation& o : landmark.observations) metric |= o.inverse_depth.has_value();
  }
  for (const auto& [id, line] : state.lines) {
    if (!sees(line, leaving) || sees(line, newest)) continue;
    equations.add_line(line);
    for (const LineObservation& o : line.observations) metric |= o.second.has_value();
  }
  if (const auto reference = scale_reference(state)) equations.add_distance(*reference);
  for (const DistanceObservation& distance : state.distances)
    if (distance.from == leaving || distance.to == leaving) {
      equations.add_distance(distance);
      metric = true;
    }
  for (const HeightObservation& height : state.heights)
    if (height.keyframe == leaving) {
      equations.add_height(height);
      metric = true;
    }
  for (const PlaneObservation& observation : state.plane_observations)
    if (observation.keyframe == leaving) {
      equations.add_plane_observation(observation);
      metric = true;
    }
  for (const PosePrior& prior : state.pose_priors)
    if (prior.keyframe == leaving) {
      equations.add_pose_prior(prior);
      metric |= !prior.information.topRows<3>().isZero(0);
    }
  for (const WorldObservation& observation : state.world_observations)
    if (observation.keyframe == leaving) equations.add_world_observation(observation);
  for (const MotionObservation& motion : state.motions)
    if (motion.from == leaving || motion.to == leaving) {
      equations.add_motion(motion);
      metric |= is_full(motion);
    }
  equations.add_prior();
  state.prior = make_prior(marginalize_first(equations.form, gone.columns()), variables, equations);
  state.prior_is_metric |= metric;

  erase_keyframe(state, leaving, newest, planes, worlds);
  if (was_fixed) state.fixed.reset();
  // Where everything the leaving keyframe saw is still in view, nothing went into the prior.
  const auto& [oldest, T_map_oldest] = *state.keyframes.begin();
  if (state.options.hold_oldest) {
    if (!state.prior.keyframes.empty() && state.prior.keyframes.front() == oldest)
      hold_first(state.prior);
    state.fixed = oldest;
  } else if (!state.fixed && !holds_pose(state.prior) && !has_full_pose_prior(state)) {
    state.fixed = oldest;
  }
  if (state.options.scale_drift > 0)
    relax_scale(state.prior, T_map_oldest.translation(), state.options.scale_drift);
  state.prior_holds_scale = holds_scale(state.prior, T_map_oldest.translation());
}

}  // namespace placegraph
