#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

using Kind = WindowVariable::Kind;

bool contains(const WindowState& state, const WindowVariable& variable) {
  switch (variable.kind) {
    case Kind::kPlane:
      return state.planes.contains(variable.plane());
    case Kind::kManhattanFrame:
      return state.manhattan_frames.contains(variable.manhattan_frame());
    default:
      return state.keyframes.contains(variable.keyframe());
  }
}

/// The estimates of a factor's variables and pointers to them; empty if one is not in the window.
struct FactorValues {
  std::vector<Variable> values;
  std::vector<const Variable*> pointers;

  FactorValues(const WindowState& state, const WindowFactor& factor) {
    for (const WindowVariable& variable : factor.variables) {
      if (!contains(state, variable)) return;
      values.push_back(value_of(state, variable));
    }
    for (const Variable& value : values) pointers.push_back(&value);
  }
};

int points_on(const WindowState& state, PlaneId plane) {
  int points = 0;
  for (const auto& [id, landmark] : state.landmarks)
    points += landmark.on_plane && landmark.on_plane->plane == plane;
  return points;
}

/// Whether points determine the plane of a height; otherwise the height does not measure the scale.
bool lies_among_points(const WindowState& state, const WindowFactor& factor) {
  return std::any_of(
      factor.variables.begin(), factor.variables.end(), [&](const WindowVariable& variable) {
        return variable.kind == Kind::kPlane && points_on(state, variable.plane()) >= 3;
      });
}

}  // namespace

void require_variable(const WindowState& state, const WindowVariable& variable) {
  require(contains(state, variable),
          "sliding window: " + to_string(variable) + " is not in the window");
}

Variable value_of(const WindowState& state, const WindowVariable& variable) {
  switch (variable.kind) {
    case Kind::kPlane:
      return state.planes.at(variable.plane());
    case Kind::kManhattanFrame:
      return state.manhattan_frames.at(variable.manhattan_frame());
    default:
      return state.keyframes.at(variable.keyframe());
  }
}

std::optional<Vector6d> velocity_of(const WindowState& state, KeyframeId keyframe) {
  const auto at = state.keyframes.find(keyframe);
  const auto before = at == state.keyframes.begin() ? at : std::prev(at);
  const auto after = std::next(at) == state.keyframes.end() ? at : std::next(at);
  const auto from = state.stamps.find(before->first), to = state.stamps.find(after->first);
  if (from == state.stamps.end() || to == state.stamps.end() || !(to->second > from->second))
    return std::nullopt;
  return Vector6d((before->second.inverse() * after->second).log() / (to->second - from->second));
}

std::vector<WindowVariable> variables_of(const WindowState& state) {
  std::vector<WindowVariable> variables;
  for (const auto& [id, T_map_cam] : state.keyframes) variables.push_back(keyframe_variable(id));
  for (const auto& [id, plane_map] : state.planes) variables.push_back(plane_variable(id));
  for (const auto& [id, R_map_manhattan] : state.manhattan_frames)
    variables.push_back(manhattan_variable(id));
  return variables;
}

std::optional<Eigen::VectorXd> residual(const WindowState& state, const WindowFactor& factor) {
  const FactorValues at(state, factor);
  if (at.pointers.size() != factor.variables.size()) return std::nullopt;
  Eigen::VectorXd r(factor.factor->residual_size());
  if (!factor.factor->evaluate(at.pointers, r, {})) return std::nullopt;
  return r;
}

bool determines(const WindowState& state, const WindowFactor& factor,
                const WindowVariable& variable) {
  const FactorValues at(state, factor);
  Eigen::VectorXd r(factor.factor->residual_size());
  std::vector<Eigen::MatrixXd> J;
  for (const WindowVariable& one : factor.variables)
    J.emplace_back(r.size(), degrees_of_freedom(one));
  if (!factor.factor->evaluate(at.pointers, r, J)) return false;
  for (std::size_t k = 0; k < J.size(); ++k) {
    if (factor.variables[k] != variable) continue;
    bool deficient = false;
    whitening<Eigen::MatrixXd>(J[k].transpose() * J[k], &deficient);
    return !deficient;
  }
  return false;
}

std::vector<const WindowObservation*> usable_observations(const WindowState& state,
                                                          const WindowLandmark& landmark) {
  std::vector<const WindowObservation*> usable;
  if (landmark.observations.size() < 2) return usable;
  usable.reserve(landmark.observations.size());
  for (const WindowObservation& o : landmark.observations) {
    const SE3& T_map_cam = state.keyframes.at(o.keyframe);
    const Eigen::Vector3d offset_map = landmark.p_map - T_map_cam.translation();
    const double depth_m = T_map_cam.rotation().matrix().col(2).dot(offset_map);
    if (depth_m > kMinDepth_m && depth_m < 1e12) usable.push_back(&o);
  }
  if (usable.size() < 2) usable.clear();
  return usable;
}

bool is_usable(const WindowLine& line) {
  std::size_t images = line.observations.size();
  for (const LineObservation& o : line.observations) images += o.second.has_value();
  return line.observations.size() >= 2 && images >= 3;
}

bool is_full_pose_prior(const WindowState& state, const WindowFactor& factor) {
  return factor.variables.size() == 1 && factor.variables[0].kind == Kind::kKeyframe &&
         determines(state, factor, factor.variables[0]);
}

bool has_full_pose_prior(const WindowState& state) {
  return std::any_of(state.factors.begin(), state.factors.end(),
                     [&](const WindowFactor& factor) { return is_full_pose_prior(state, factor); });
}

bool has_metric_observation(const WindowState& state) {
  int positions = 0;
  for (const WindowFactor& factor : state.factors) {
    if (factor.length == WindowFactor::Length::kMeasured) return true;
    if (factor.length == WindowFactor::Length::kHeight && lies_among_points(state, factor))
      return true;
    positions += factor.length == WindowFactor::Length::kPosition;
  }
  if (positions + state.fixed.has_value() >= 2 && positions > 0) return true;
  for (const auto& [id, landmark] : state.landmarks)
    for (const WindowObservation& o : landmark.observations)
      if (o.inverse_depth) return true;
  for (const auto& [id, line] : state.lines)
    for (const LineObservation& o : line.observations)
      if (o.second) return true;
  return false;
}

std::optional<WindowFactor> scale_reference(const WindowState& state) {
  const bool free = !state.fixed && !state.prior.empty();
  if (free || state.keyframes.empty() || state.prior_holds_scale || has_metric_observation(state))
    return std::nullopt;
  const KeyframeId reference = state.fixed.value_or(state.keyframes.begin()->first);
  const Eigen::Vector3d first = state.keyframes.at(reference).translation();
  KeyframeId farthest = reference;
  double distance_m = 0;
  for (const auto& [id, T_map_cam] : state.keyframes) {
    const double to_id_m = (T_map_cam.translation() - first).norm();
    if (to_id_m > distance_m) farthest = id, distance_m = to_id_m;
  }
  if (distance_m < 1e-9) return std::nullopt;
  return WindowFactor{std::make_shared<DistanceFactor>(distance_m, 0.01 * distance_m),
                      {keyframe_variable(reference), keyframe_variable(farthest)},
                      true,
                      WindowFactor::Length::kMeasured};
}

}  // namespace placegraph
