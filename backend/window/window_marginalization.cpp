#include <placegraph/backend/window/prior_gauge.h>
#include <placegraph/backend/window/window_equations.h>
#include <placegraph/backend/window/window_marginalization.h>

#include <algorithm>
#include <iterator>

namespace placegraph {
namespace {

template <class Landmark>
bool sees(const Landmark& landmark, KeyframeId keyframe) {
  return std::any_of(landmark.observations.begin(), landmark.observations.end(),
                     [&](const auto& o) { return o.keyframe == keyframe; });
}

/// Whether the leaving keyframe observes a point or line and the newest does not: it is
/// marginalized.
template <class Landmark>
bool ends(const Landmark& landmark, KeyframeId leaving, KeyframeId newest) {
  return sees(landmark, leaving) && !sees(landmark, newest);
}

bool touches_any(const WindowFactor& factor, const std::set<WindowVariable>& variables) {
  return std::any_of(factor.variables.begin(), factor.variables.end(),
                     [&](const WindowVariable& one) { return variables.contains(one); });
}

/// The leaving keyframe, and the planes and Manhattan frames that leave with it.
/// These are not kept, and only measurements that leave with the keyframe connect them to
/// keyframes.
std::set<WindowVariable> leaving_variables(const WindowState& state, KeyframeId leaving,
                                           KeyframeId newest) {
  const WindowVariable keyframe = keyframe_variable(leaving);
  std::set<WindowVariable> touched, staying = state.kept;
  for (const PlaneId id : state.prior.planes) touched.insert(plane_variable(id));
  for (const ManhattanFrameId id : state.prior.manhattan_frames)
    touched.insert(manhattan_variable(id));
  for (const WindowFactor& factor : state.factors) {
    const bool leaves = touches(factor, keyframe);
    const bool between_keyframes =
        std::any_of(factor.variables.begin(), factor.variables.end(),
                    [](const auto& one) { return one.kind == WindowVariable::Kind::kKeyframe; });
    if (between_keyframes)
      (leaves ? touched : staying).insert(factor.variables.begin(), factor.variables.end());
  }
  for (const auto& [id, landmark] : state.landmarks)
    if (landmark.on_plane)
      (ends(landmark, leaving, newest) ? touched : staying)
          .insert(plane_variable(landmark.on_plane->plane));
  std::set<WindowVariable> result{keyframe};
  for (const WindowVariable& one : touched)
    if (one.kind != WindowVariable::Kind::kKeyframe && !staying.contains(one)) result.insert(one);
  return result;
}

/// Adds the landmarks and factors that leave, and the prior; returns whether any measures the
/// scale.
bool add_leaving(const WindowState& state, const std::set<WindowVariable>& gone, KeyframeId leaving,
                 KeyframeId newest, WindowEquations& equations) {
  bool metric = false;
  for (const auto& [id, landmark] : state.landmarks) {
    if (!ends(landmark, leaving, newest)) continue;
    equations.add_landmark(landmark);
    for (const WindowObservation& o : landmark.observations) metric |= o.inverse_depth.has_value();
  }
  for (const auto& [id, line] : state.lines) {
    if (!ends(line, leaving, newest)) continue;
    equations.add_line(line);
    for (const LineObservation& o : line.observations) metric |= o.second.has_value();
  }
  if (const auto reference = scale_reference(state)) equations.add(*reference);
  for (const WindowFactor& factor : state.factors) {
    if (!touches_any(factor, gone)) continue;
    equations.add(factor);
    metric |= factor.length != WindowFactor::Length::kNone;
  }
  equations.add_prior();
  return metric;
}

/// The nonzero part of a form as a prior on its variables.
MarginalPrior make_prior(const QuadraticForm& form, const std::vector<WindowVariable>& variables,
                         const WindowEquations& equations) {
  MarginalPrior prior;
  std::vector<Eigen::Index> columns;
  Eigen::Index column = 0;
  for (const WindowVariable& variable : variables) {
    const int size = degrees_of_freedom(variable);
    if (!form.H.middleCols(column, size).isZero(0)) {
      const Variable& lin = equations.linearization_point(variable);
      if (variable.kind == WindowVariable::Kind::kPlane) {
        prior.planes.push_back(variable.plane());
        prior.plane_lin.push_back(std::get<Plane3>(lin));
      } else if (variable.kind == WindowVariable::Kind::kManhattanFrame) {
        prior.manhattan_frames.push_back(variable.manhattan_frame());
        prior.R_map_manhattan_lin.push_back(std::get<SO3>(lin));
      } else {
        prior.keyframes.push_back(variable.keyframe());
        prior.T_map_cam_lin.push_back(std::get<SE3>(lin));
      }
      for (int i = 0; i < size; ++i) columns.push_back(column + i);
    }
    column += size;
  }
  if (columns.empty()) return prior;
  const SquareRootForm root = square_root({form.H(columns, columns), form.b(columns)});
  prior.J = root.J;
  prior.e = root.e;
  return prior;
}

/// Removes the marginalized variables and measurements from the window.
void erase_leaving(WindowState& state, const std::set<WindowVariable>& gone, KeyframeId leaving,
                   KeyframeId newest) {
  const auto erase_from = [&](auto& landmarks) {
    for (auto it = landmarks.begin(); it != landmarks.end();) {
      auto& landmark = it->second;
      const bool gone_too = ends(landmark, leaving, newest);
      std::erase_if(landmark.observations, [&](const auto& o) { return o.keyframe == leaving; });
      it = gone_too || landmark.observations.empty() ? landmarks.erase(it) : std::next(it);
    }
  };
  erase_from(state.landmarks);
  erase_from(state.lines);
  std::erase_if(state.factors,
                [&](const WindowFactor& factor) { return touches_any(factor, gone); });
  for (const WindowVariable& variable : gone) {
    state.kept.erase(variable);
    if (variable.kind == WindowVariable::Kind::kPlane) state.planes.erase(variable.plane());
    if (variable.kind == WindowVariable::Kind::kKeyframe) {
      state.keyframes.erase(variable.keyframe());
      state.stamps.erase(variable.keyframe());
    }
    if (variable.kind != WindowVariable::Kind::kManhattanFrame) continue;
    state.manhattan_frames.erase(variable.manhattan_frame());
    if (state.held_manhattan_frame == variable.manhattan_frame())
      state.held_manhattan_frame.reset();
  }
}

/// Fixes the pose and the scale of the window after a keyframe has left.
void settle_gauge(WindowState& state, bool was_fixed) {
  if (was_fixed) state.fixed.reset();
  // If all landmarks of the leaving keyframe are still in view, nothing is added to the prior.
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

}  // namespace

void marginalize_keyframe(WindowState& state, KeyframeId leaving) {
  const KeyframeId newest = state.keyframes.rbegin()->first;
  const std::set<WindowVariable> gone = leaving_variables(state, leaving, newest);
  // Leaving variables are first; a held keyframe has no columns.
  const auto is_constant = [&](const WindowVariable& variable) {
    return variable.kind == WindowVariable::Kind::kKeyframe && state.fixed == variable.keyframe();
  };
  std::vector<WindowVariable> order, staying;
  for (const WindowVariable& variable : gone)
    if (!is_constant(variable)) order.push_back(variable);
  const Eigen::Index columns_gone = columns_of(order);
  for (const WindowVariable& variable : variables_of(state))
    if (!gone.contains(variable) && !is_constant(variable)) staying.push_back(variable);
  order.insert(order.end(), staying.begin(), staying.end());

  WindowEquations equations(state, order, true);
  const bool metric = add_leaving(state, gone, leaving, newest, equations);
  state.prior = make_prior(marginalize_first(equations.form, columns_gone), staying, equations);
  state.prior_is_metric |= metric;

  const bool was_fixed = state.fixed == leaving;
  erase_leaving(state, gone, leaving, newest);
  settle_gauge(state, was_fixed);
}

std::vector<KeyframeId> marginalize_window(WindowState& state) {
  std::vector<KeyframeId> left;
  while (static_cast<int>(state.keyframes.size()) > state.options.max_keyframes) {
    // The newest keyframe is never marginalized.
    const auto newest = std::prev(state.keyframes.end());
    const auto oldest = std::find_if(state.keyframes.begin(), newest, [&](const auto& keyframe) {
      return !state.kept.contains(keyframe_variable(keyframe.first));
    });
    if (oldest == newest) break;
    left.push_back(oldest->first);
    const auto held_before = state.fixed;
    marginalize_keyframe(state, left.back());
    if (state.fixed && state.fixed != held_before) state.constrained_to_map = false;
  }
  return left;
}

}  // namespace placegraph
