#include <placegraph/backend/linear/marginalization.h>
#include <placegraph/backend/window/window_information.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace placegraph {
namespace {

using Kind = WindowVariables::Kind;
using WindowVariable = WindowVariables::Variable;

}  // namespace

WindowInformation window_information(const WindowState& state) {
  WindowInformation result;
  for (const auto& [id, plane_map] : state.planes)
    result.variables.order.push_back({Kind::kPlane, id});
  for (const auto& [id, R_map_world] : state.worlds)
    result.variables.order.push_back({Kind::kWorld, id});
  for (const auto& [id, T_map_cam] : state.keyframes)
    result.variables.order.push_back({Kind::kKeyframe, id});
  WindowEquations equations(state, result.variables, false);
  for (const auto& [id, landmark] : state.landmarks) equations.add_landmark(landmark);
  for (const auto& [id, line] : state.lines) equations.add_line(line);
  for (const DistanceObservation& distance : state.distances) equations.add_distance(distance);
  for (const HeightObservation& height : state.heights) equations.add_height(height);
  for (const PlaneObservation& observation : state.plane_observations)
    equations.add_plane_observation(observation);
  for (const PosePrior& prior : state.pose_priors) equations.add_pose_prior(prior);
  for (const WorldObservation& observation : state.world_observations)
    equations.add_world_observation(observation);
  for (const MotionObservation& motion : state.motions) equations.add_motion(motion);
  equations.add_prior();
  result.H = std::move(equations.form.H);
  return result;
}

Eigen::MatrixXd joint_information(const WindowState& state, const WindowInformation& information,
                                  const std::vector<WindowVariable>& variables) {
  // All else first, so that it can be marginalized.
  std::vector<Eigen::Index> columns;
  std::vector<Eigen::Index> asked(variables.size(), -1);
  Eigen::Index column = 0;
  for (const WindowVariable& variable : information.variables.order) {
    const auto k = std::find(variables.begin(), variables.end(), variable);
    if (k != variables.end())
      asked[static_cast<std::size_t>(k - variables.begin())] = column;
    else if (variable.kind != Kind::kKeyframe || variable.id != state.fixed)
      for (int i = 0; i < WindowVariables::size(variable); ++i) columns.push_back(column + i);
    column += WindowVariables::size(variable);
  }
  const auto others = static_cast<Eigen::Index>(columns.size());
  for (std::size_t k = 0; k < variables.size(); ++k)
    for (int i = 0; i < WindowVariables::size(variables[k]); ++i) columns.push_back(asked[k] + i);
  const QuadraticForm form{information.H(columns, columns),
                           Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns.size()))};
  return marginalize_first(form, others).H;
}

Matrix6d absolute_information(const WindowState& state, const WindowInformation& information,
                              std::int64_t keyframe) {
  return clamp_to_semidefinite(joint_information(state, information, {{Kind::kKeyframe, keyframe}}),
                               1e-9);
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
  QuadraticForm joint{
      joint_information(state, information, {{Kind::kKeyframe, from}, {Kind::kKeyframe, to}}),
      Eigen::VectorXd::Zero(12)};
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

std::optional<Eigen::Matrix3d> world_covariance(const WindowState& state,
                                                const WindowInformation& information,
                                                std::int64_t world, std::int64_t keyframe) {
  const SO3 R_world_cam =
      state.worlds.at(world).inverse() * state.keyframes.at(keyframe).rotation();
  std::vector<WindowVariable> variables;
  const bool held = state.fixed == keyframe;
  if (!held) variables.push_back({Kind::kKeyframe, keyframe});
  variables.push_back({Kind::kWorld, world});
  QuadraticForm form{joint_information(state, information, variables), {}};
  form.b = Eigen::VectorXd::Zero(form.H.rows());
  if (!held) form = marginalize_first(form, 3);  // where the keyframe is
  const Eigen::VectorXd scale = form.H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * form.H *
                                                             scale.asDiagonal());
  constexpr double kFloor = 1e-12;
  if (!(eigen.eigenvalues()[0] > kFloor)) return std::nullopt;
  // R_cam_world turns on its right by that of the world, less that of the camera seen from it.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, form.H.cols());
  J.rightCols<3>().setIdentity();
  if (!held) J.leftCols<3>() = -R_world_cam.matrix();
  const Eigen::MatrixXd root = J * scale.asDiagonal() * eigen.eigenvectors() *
                               eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  return Eigen::Matrix3d(root * root.transpose());
}

std::optional<Eigen::Matrix3d> plane_covariance(const WindowState& state,
                                                const WindowInformation& information,
                                                std::int64_t plane, std::int64_t keyframe) {
  Eigen::Matrix<double, 3, 6> J_pose;
  Eigen::Matrix3d J_plane;
  transform_to(state.keyframes.at(keyframe), state.planes.at(plane), &J_pose, &J_plane);
  const Eigen::Matrix3d J_inverse = J_plane.inverse();
  Eigen::Matrix3d H;
  if (state.fixed == keyframe) {
    H = J_inverse.transpose() * joint_information(state, information, {{Kind::kPlane, plane}}) *
        J_inverse;
  } else {
    // From (xi, w of the plane) to (xi, w of the plane in the camera), of which a window that
    // floats as a whole leaves xi open.
    QuadraticForm joint{
        joint_information(state, information, {{Kind::kKeyframe, keyframe}, {Kind::kPlane, plane}}),
        Eigen::VectorXd::Zero(9)};
    Eigen::Matrix<double, 9, 9> M = Eigen::Matrix<double, 9, 9>::Identity();
    M.bottomLeftCorner<3, 6>() = -J_inverse * J_pose;
    M.bottomRightCorner<3, 3>() = J_inverse;
    const Eigen::VectorXd size_before =
        (M.cwiseAbs().transpose() * joint.H.cwiseAbs() * M.cwiseAbs()).diagonal().head<6>();
    joint.H = M.transpose() * joint.H * M;
    H = marginalize_first(joint, 6, &size_before).H;
  }
  const Eigen::Vector3d scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scale.asDiagonal() * H *
                                                             scale.asDiagonal());
  constexpr double kFloor = 1e-12;
  if (!(eigen.eigenvalues()[0] > kFloor)) return std::nullopt;
  const Eigen::Matrix3d root = scale.asDiagonal() * eigen.eigenvectors() *
                               eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  return Eigen::Matrix3d(root * root.transpose());
}

}  // namespace placegraph
