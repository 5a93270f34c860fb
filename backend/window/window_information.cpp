#include <placegraph/backend/linear/marginalization.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_equations.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Kind = WindowVariable::Kind;

bool is_held(const WindowState& state, const WindowVariable& variable) {
  return variable.kind == Kind::kKeyframe && state.fixed == variable.keyframe();
}

/// Inverse of a positive semi-definite matrix; directions without information are left out.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& H) {
  constexpr double kNothing = 1e-10;  // share of the largest eigenvalue
  const Eigen::VectorXd unit = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(unit.asDiagonal() * H *
                                                             unit.asDiagonal());
  const Eigen::ArrayXd lambda = eigen.eigenvalues().array();
  const Eigen::VectorXd inverse =
      (lambda > kNothing * lambda.maxCoeff()).select(lambda.inverse(), 0.0);
  const Eigen::MatrixXd V = unit.asDiagonal() * eigen.eigenvectors();
  return V * inverse.asDiagonal() * V.transpose();
}

/// The information of a keyframe's pose in the map, all other variables marginalized.
Matrix6d absolute_information(const SlidingWindow& window, KeyframeId keyframe) {
  return clamp_to_semidefinite(
      joint_information(window.state(), window.information(), {keyframe_variable(keyframe)}), 1e-9);
}

std::optional<Matrix6d> inverse_if_full(const Matrix6d& information) {
  bool deficient = false;
  whitening(information, &deficient);
  if (deficient) return std::nullopt;
  return Matrix6d(information.llt().solve(Matrix6d::Identity()));
}

/// J information^-1 J^T; empty if a direction of the information is undetermined.
std::optional<Eigen::Matrix3d> propagated_covariance(const Eigen::MatrixXd& information,
                                                     const Eigen::MatrixXd& J) {
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * information *
                                                             scale.asDiagonal());
  // Of a matrix of unit diagonal: four orders above rounding. Chosen.
  constexpr double kFloor = 1e-12;
  if (!(eigen.eigenvalues()[0] > kFloor)) return std::nullopt;
  const Eigen::MatrixXd root = J * scale.asDiagonal() * eigen.eigenvectors() *
                               eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  return Eigen::Matrix3d(root * root.transpose());
}

}  // namespace

WindowInformation window_information(const WindowState& state) {
  WindowInformation result;
  const std::vector<WindowVariable> all = variables_of(state);
  const auto keyframes_end = all.begin() + static_cast<std::ptrdiff_t>(state.keyframes.size());
  result.variables.assign(keyframes_end, all.end());
  result.variables.insert(result.variables.end(), all.begin(), keyframes_end);
  WindowEquations equations(state, result.variables, false);
  equations.collect_image_sums();
  for (const auto& [id, landmark] : state.landmarks) equations.add_landmark(landmark);
  for (const auto& [id, line] : state.lines) equations.add_line(line);
  const QuadraticForm by_images = equations.form;
  for (const WindowFactor& factor : state.factors) equations.add(factor);
  const Eigen::MatrixXd H_measured = equations.form.H;
  equations.add_prior();

  // Share of the prior that keeps directions finite which no image determines. Chosen.
  constexpr double kShareOfPrior = 0.01;
  const Eigen::MatrixXd weak_prior = kShareOfPrior * (equations.form.H - H_measured);
  WindowInformation::WithoutPrior& without_prior = result.without_prior;
  without_prior.covariance = pseudo_inverse(H_measured + weak_prior);
  without_prior.gradient = by_images.b;
  without_prior.images = std::move(*equations.images);
  without_prior.images.scatter += H_measured - by_images.H + weak_prior;
  result.H = std::move(equations.form.H);
  return result;
}

Eigen::MatrixXd joint_information(const WindowState& state, const WindowInformation& information,
                                  const std::vector<WindowVariable>& variables) {
  // All other variables first, so that they can be marginalized.
  std::vector<Eigen::Index> columns;
  std::vector<Eigen::Index> asked(variables.size(), -1);
  Eigen::Index column = 0;
  for (const WindowVariable& variable : information.variables) {
    const auto k = std::find(variables.begin(), variables.end(), variable);
    if (k != variables.end())
      asked[static_cast<std::size_t>(k - variables.begin())] = column;
    else if (!is_held(state, variable))
      for (int i = 0; i < degrees_of_freedom(variable); ++i) columns.push_back(column + i);
    column += degrees_of_freedom(variable);
  }
  const auto others = static_cast<Eigen::Index>(columns.size());
  for (std::size_t k = 0; k < variables.size(); ++k)
    for (int i = 0; i < degrees_of_freedom(variables[k]); ++i) columns.push_back(asked[k] + i);
  const QuadraticForm form{information.H(columns, columns),
                           Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns.size()))};
  return marginalize_first(form, others).H;
}

Matrix6d relative_information(const SlidingWindow& window, KeyframeId from, KeyframeId to) {
  const WindowState& state = window.state();
  for (const KeyframeId id : {from, to}) require_variable(state, keyframe_variable(id));
  require(from != to, "sliding window: a relative pose needs two keyframes");
  const SE3 T_from_to = state.keyframes.at(from).inverse() * state.keyframes.at(to);
  // The held keyframe is the frame of the map and of the prior's information.
  if (state.fixed == from) return absolute_information(window, to);
  if (state.fixed == to) {
    // T_from exp(x) changes T_from_to as exp(xi) on its right does, x = -Ad(T_from_to) xi.
    const Matrix6d M = T_from_to.adjoint();
    return M.transpose() * absolute_information(window, from) * M;
  }
  QuadraticForm joint{joint_information(state, window.information(),
                                        {keyframe_variable(from), keyframe_variable(to)}),
                      Eigen::VectorXd::Zero(12)};
  // From (xi_from, xi_to) to (xi_from, xi of T_from_to): xi_to = xi + Ad(T_from_to^-1) xi_from. A
  // window without a prior does not constrain xi_from then; its remaining entries are rounding.
  Eigen::Matrix<double, 12, 12> M = Eigen::Matrix<double, 12, 12>::Identity();
  M.bottomLeftCorner<6, 6>() = T_from_to.inverse().adjoint();
  const Eigen::VectorXd size_before =
      (M.cwiseAbs().transpose() * joint.H.cwiseAbs() * M.cwiseAbs()).diagonal().head<6>();
  joint.H = M.transpose() * joint.H * M;
  const QuadraticForm relative = marginalize_first(joint, 6, &size_before);
  return clamp_to_semidefinite(relative.H, 1e-9);
}

std::optional<Matrix6d> relative_covariance(const SlidingWindow& window, KeyframeId from,
                                            KeyframeId to) {
  return inverse_if_full(relative_information(window, from, to));
}

std::optional<Matrix6d> keyframe_covariance(const SlidingWindow& window, KeyframeId keyframe) {
  require_variable(window.state(), keyframe_variable(keyframe));
  if (!window.state().constrained_to_map) return std::nullopt;
  if (window.state().fixed == keyframe) return Matrix6d(Matrix6d::Zero());
  return inverse_if_full(absolute_information(window, keyframe));
}

std::optional<Eigen::Matrix3d> manhattan_covariance(const SlidingWindow& window,
                                                    ManhattanFrameId manhattan_frame,
                                                    KeyframeId keyframe) {
  const WindowState& state = window.state();
  require_variable(state, keyframe_variable(keyframe));
  require_variable(state, manhattan_variable(manhattan_frame));
  const SO3 R_world_cam = state.manhattan_frames.at(manhattan_frame).inverse() *
                          state.keyframes.at(keyframe).rotation();
  std::vector<WindowVariable> variables;
  const bool held = state.fixed == keyframe;
  if (!held) variables.push_back(keyframe_variable(keyframe));
  variables.push_back(manhattan_variable(manhattan_frame));
  QuadraticForm form{joint_information(state, window.information(), variables), {}};
  form.b = Eigen::VectorXd::Zero(form.H.rows());
  if (!held) form = marginalize_first(form, 3);  // position of the keyframe
  // The right tangent of R_cam_manhattan is that of the Manhattan frame minus that of the camera,
  // transformed to the Manhattan frame.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, form.H.cols());
  J.rightCols<3>().setIdentity();
  if (!held) J.leftCols<3>() = -R_world_cam.matrix();
  return propagated_covariance(form.H, J);
}

std::optional<Eigen::Matrix3d> plane_covariance(const SlidingWindow& window, PlaneId plane,
                                                KeyframeId keyframe) {
  const WindowState& state = window.state();
  require_variable(state, keyframe_variable(keyframe));
  require_variable(state, plane_variable(plane));
  Eigen::Matrix<double, 3, 6> J_pose;
  Eigen::Matrix3d J_plane;
  transform_to(state.keyframes.at(keyframe), state.planes.at(plane), &J_pose, &J_plane);
  const Eigen::Matrix3d J_inverse = J_plane.inverse();
  Eigen::Matrix3d H;
  if (state.fixed == keyframe) {
    H = J_inverse.transpose() *
        joint_information(state, window.information(), {plane_variable(plane)}) * J_inverse;
  } else {
    // From (xi, w of the plane) to (xi, w of the plane in the camera), where an unconstrained
    // window leaves xi undetermined.
    QuadraticForm joint{joint_information(state, window.information(),
                                          {keyframe_variable(keyframe), plane_variable(plane)}),
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
  // Of a matrix of unit diagonal: four orders above rounding. Chosen.
  constexpr double kFloor = 1e-12;
  if (!(eigen.eigenvalues()[0] > kFloor)) return std::nullopt;
  const Eigen::Matrix3d root = scale.asDiagonal() * eigen.eigenvectors() *
                               eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  return Eigen::Matrix3d(root * root.transpose());
}

std::optional<Eigen::Matrix3d> landmark_covariance(const SlidingWindow& window,
                                                   LandmarkId landmark) {
  // Ratio of eigenvalues: four orders above rounding. Chosen.
  constexpr double kLeastCondition = 1e-12;
  const WindowState& state = window.state();
  const auto found = state.landmarks.find(landmark);
  if (found == state.landmarks.end()) return std::nullopt;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (const WindowObservation& o : found->second.observations) {
    const SE3& T_map_cam = state.keyframes.at(o.keyframe);
    const Eigen::Matrix3d R_cam_map = T_map_cam.rotation().matrix().transpose();
    const PointInCamera point(T_map_cam.rotation().matrix(), T_map_cam.translation(),
                              found->second.p_map);
    if (!point.projectable()) continue;
    const Eigen::Matrix<double, 2, 3> J =
        reprojection_of(state.camera, o).derivative(point.p_cam) * R_cam_map;
    H += J.transpose() * J;
    if (!o.inverse_depth) continue;
    // d (1 / z) / dp
    const double z = point.p_cam.z();
    const Eigen::RowVector3d of_depth = -R_cam_map.row(2) / (z * z * o.sigma_inverse_depth);
    H += of_depth.transpose() * of_depth;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(H);
  if (!(eigen.eigenvalues()[0] > kLeastCondition * eigen.eigenvalues()[2])) return std::nullopt;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}

double sigma_log_length_ratio(const SlidingWindow& window, KeyframeId first, KeyframeId middle,
                              KeyframeId last) {
  const WindowState& state = window.state();
  for (const KeyframeId id : {first, middle, last}) require_variable(state, keyframe_variable(id));
  require(first != middle && middle != last && first != last,
          "sliding window: a ratio of lengths needs three different keyframes");
  const SE3 &T_a = state.keyframes.at(first), &T_b = state.keyframes.at(middle),
            &T_c = state.keyframes.at(last);
  const Eigen::Vector3d ab = T_b.translation() - T_a.translation();
  const Eigen::Vector3d bc = T_c.translation() - T_b.translation();
  if (!(ab.squaredNorm() > 0) || !(bc.squaredNorm() > 0))
    return std::numeric_limits<double>::infinity();
  // d log|x| = x^T dx / |x|^2, and a keyframe moves by R times the translation of its tangent.
  const Eigen::RowVector3d d_ab = ab.transpose() / ab.squaredNorm();
  const Eigen::RowVector3d d_bc = bc.transpose() / bc.squaredNorm();
  Eigen::RowVectorXd J = Eigen::RowVectorXd::Zero(18);
  J.segment<3>(0) = d_ab * T_a.rotation().matrix();
  J.segment<3>(6) = -(d_ab + d_bc) * T_b.rotation().matrix();
  J.segment<3>(12) = d_bc * T_c.rotation().matrix();

  // The ratio is independent of the gauge, whose undetermined directions are left out of the
  // inverse. The information is scaled to a unit diagonal, because metres and radians are not
  // comparable.
  const Eigen::MatrixXd H = joint_information(
      state, window.information(),
      {keyframe_variable(first), keyframe_variable(middle), keyframe_variable(last)});
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * H *
                                                             scale.asDiagonal());
  const Eigen::VectorXd share =
      eigen.eigenvectors().transpose() * (J * scale.asDiagonal()).transpose();
  // Eigenvalue of an undetermined direction, of a matrix of unit diagonal. Chosen.
  constexpr double kOpen = 1e-10;
  double variance = 0;
  for (Eigen::Index k = 0; k < share.size(); ++k)
    if (eigen.eigenvalues()[k] > kOpen) variance += share[k] * share[k] / eigen.eigenvalues()[k];
  return std::sqrt(variance);
}

namespace {

std::optional<Eigen::Vector2d> residual_of(const WindowState& state, const WindowObservation& o,
                                           const Reprojection& reprojection) {
  const auto keyframe = state.keyframes.find(o.keyframe);
  const auto landmark = state.landmarks.find(o.landmark);
  if (keyframe == state.keyframes.end() || landmark == state.landmarks.end()) return std::nullopt;
  const SE3& T_map_cam = keyframe->second;
  const PointInCamera point(T_map_cam.rotation().matrix(), T_map_cam.translation(),
                            landmark->second.p_map);
  if (!point.projectable()) return std::nullopt;
  return reprojection.residual(point.p_cam);
}

}  // namespace

std::optional<Eigen::Vector2d> residual_px(const SlidingWindow& window,
                                           const WindowObservation& o) {
  const WindowState& state = window.state();
  return residual_of(state, o, Reprojection(state.camera, o.px, 1.0));
}

std::optional<Eigen::Vector2d> residual_sigmas(const SlidingWindow& window,
                                               const WindowObservation& o) {
  return residual_of(window.state(), o, reprojection_of(window.state().camera, o));
}

std::optional<Eigen::Vector2d> residual_px(const SlidingWindow& window, const LineObservation& o) {
  const WindowState& state = window.state();
  const auto keyframe = state.keyframes.find(o.keyframe);
  const auto line = state.lines.find(o.line);
  if (keyframe == state.keyframes.end() || line == state.lines.end()) return std::nullopt;
  LineReprojectionFactor::Residual r;
  LineReprojectionFactor(state.camera, o.start_px, o.end_px, 1.0)
      .compute(keyframe->second, line->second.line_map, r, nullptr);
  return Eigen::Vector2d(r);
}

std::optional<Eigen::VectorXd> residual_sigmas(const SlidingWindow& window,
                                               const WindowFactor& factor) {
  return residual(window.state(), factor);
}

}  // namespace placegraph
