#include <placegraph/backend/marginalization.h>
#include <placegraph/backend/window_information.h>

#include <algorithm>
#include <map>

namespace placegraph {

WindowInformation window_information(const WindowState& state) {
  WindowInformation result;
  for (const auto& [id, plane_map] : state.planes) result.variables.order.push_back({true, id});
  for (const auto& [id, T_map_cam] : state.keyframes) result.variables.order.push_back({false, id});
  WindowEquations equations(state, result.variables, false);
  for (const auto& [id, landmark] : state.landmarks) equations.add_landmark(landmark);
  for (const auto& [id, line] : state.lines) equations.add_line(line);
  for (const DistanceObservation& distance : state.distances) equations.add_distance(distance);
  for (const HeightObservation& height : state.heights) equations.add_height(height);
  for (const PosePrior& prior : state.pose_priors) equations.add_pose_prior(prior);
  equations.add_prior();
  result.H = std::move(equations.form.H);
  return result;
}

Eigen::MatrixXd joint_information(const WindowState& state, const WindowInformation& information,
                                  const std::vector<std::int64_t>& keyframes) {
  // All else first, so that it can be marginalized.
  std::vector<Eigen::Index> columns;
  std::map<std::int64_t, Eigen::Index> asked;
  Eigen::Index column = 0;
  for (const WindowVariables::Variable& variable : information.variables.order) {
    const int size = WindowVariables::size(variable);
    const bool is_asked = !variable.is_plane && std::find(keyframes.begin(), keyframes.end(),
                                                          variable.id) != keyframes.end();
    if (is_asked)
      asked[variable.id] = column;
    else if (variable.is_plane || variable.id != state.fixed)
      for (int k = 0; k < size; ++k) columns.push_back(column + k);
    column += size;
  }
  const auto others = static_cast<Eigen::Index>(columns.size());
  for (const std::int64_t id : keyframes)
    for (int k = 0; k < 6; ++k) columns.push_back(asked.at(id) + k);
  const QuadraticForm form{information.H(columns, columns),
                           Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns.size()))};
  return marginalize_first(form, others).H;
}

Matrix6d absolute_information(const WindowState& state, const WindowInformation& information,
                              std::int64_t keyframe) {
  return clamp_to_semidefinite(joint_information(state, information, {keyframe}), 1e-9);
}

Matrix6d relative_information(const WindowState& state, const WindowInformation& information,
                              std::int64_t from, std::int64_t to) {
  const SE3 T_from_to = state.keyframes.at(from).inverse() * state.keyframes.at(to);
  // The held keyframe is the map's frame: what the prior knows, it knows from there.
  if (state.fixed == from) return absolute_information(state, information, to);
  if (state.fixed == to) {
    // T_from exp(x) changes T_from_to as exp(xi) on its right does, x = -Ad(T_from_to) xi.
    const Matrix6d M = T_from_to.adjoint();
    return M.transpose() * absolute_information(state, information, from) * M;
  }
  QuadraticForm joint{joint_information(state, information, {from, to}), Eigen::VectorXd::Zero(12)};
  // From (xi_from, xi_to) to (xi_from, xi of T_from_to): xi_to = xi + Ad(T_from_to^-1) xi_from. A
  // window without a prior does not constrain xi_from then, all that is left of it is rounding.
  Eigen::Matrix<double, 12, 12> M = Eigen::Matrix<double, 12, 12>::Identity();
  M.bottomLeftCorner<6, 6>() = T_from_to.inverse().adjoint();
  const Eigen::VectorXd size_before =
      (M.cwiseAbs().transpose() * joint.H.cwiseAbs() * M.cwiseAbs()).diagonal().head<6>();
  joint.H = M.transpose() * joint.H * M;
  const QuadraticForm relative = marginalize_first(joint, 6, &size_before);
  return clamp_to_semidefinite(relative.H, 1e-9);
}

}  // namespace placegraph
