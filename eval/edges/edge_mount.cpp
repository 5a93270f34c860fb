#include <placegraph/eval/edges/edge_mount.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

/// Errors of the odometry edges if the truth's frame is moved.
std::vector<EdgeError> moved_errors(const std::vector<RelativePoseConstraint>& odometry,
                                    const TrueNodes& truth, const SE3& T_truth_cam) {
  return edge_errors(odometry, mounted(truth, {T_truth_cam, Vector6d::Zero(), 0}));
}

/// Weights of the edges: 1 over the median NEES, less for errors beyond about 99 % of it.
std::vector<double> weights_of(const std::vector<EdgeError>& errors) {
  constexpr double kFar = 2.8;  // bound of chi-squared over six
  std::vector<double> nees, judged;
  for (const EdgeError& edge : errors) {
    nees.push_back(0);
    if (edge.state != EdgeState::kJudged) continue;
    const Eigen::MatrixXd covariance = edge.stated + edge.of_truth;
    nees.back() =
        edge.error.dot(covariance.ldlt().solve(edge.error)) / static_cast<double>(edge.axes.size());
    judged.push_back(nees.back());
  }
  const double usual = judged.empty() ? 1 : std::max(1.0, median_of(judged));
  std::vector<double> weights;
  for (const double value : nees)
    weights.push_back(1 / (usual * std::max(1.0, std::sqrt(value / (kFar * usual)))));
  return weights;
}

/// Normal equations of a small motion of the truth's frame.
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
};

NormalEquations linearized(const std::vector<RelativePoseConstraint>& odometry,
                           const TrueNodes& truth, const SE3& T_truth_cam) {
  constexpr double kStep = 1e-5;  // for central differences [m, rad]
  const std::vector<EdgeError> errors = moved_errors(odometry, truth, T_truth_cam);
  const std::vector<double> weights = weights_of(errors);
  std::array<std::vector<EdgeError>, 6> forward, backward;
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = kStep * Vector6d::Unit(k);
    forward[k] = moved_errors(odometry, truth, T_truth_cam.plus(step));
    backward[k] = moved_errors(odometry, truth, T_truth_cam.plus(-step));
  }
  NormalEquations result;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i].state != EdgeState::kJudged) continue;
    Eigen::MatrixXd J(errors[i].error.size(), 6);
    for (int k = 0; k < 6; ++k)
      J.col(k) = (forward[k][i].error - backward[k][i].error) / (2 * kStep);
    const Eigen::MatrixXd covariance = errors[i].stated + errors[i].of_truth;
    const Eigen::MatrixXd weighted = weights[i] * covariance.ldlt().solve(J);
    result.H += J.transpose() * weighted;
    result.g += weighted.transpose() * errors[i].error;
  }
  return result;
}

}  // namespace

TrueNodes mounted(TrueNodes truth, const TruthMount& mount) {
  for (auto& [node, pose] : truth.T_world_node) pose = pose * mount.T_truth_cam;
  truth.fitted += mount.parameters;
  return truth;
}

TruthMount fit_mount(const std::vector<RelativePoseConstraint>& edges, const TrueNodes& truth) {
  std::vector<RelativePoseConstraint> odometry;
  for (const RelativePoseConstraint& edge : edges)
    if (edge.source == ConstraintSource::kOdometry) odometry.push_back(edge);
  Vector6d information;  // a priori
  information.head<3>().setConstant(1 / (0.1 * 0.1));
  information.tail<3>().setConstant(1 / (kRadPerDeg * kRadPerDeg));
  const Matrix6d prior = information.asDiagonal();
  TruthMount mount;
  for (int iteration = 0; iteration < 6; ++iteration) {
    const NormalEquations normal = linearized(odometry, truth, mount.T_truth_cam);
    const Eigen::LDLT<Matrix6d> solver(normal.H + prior);
    const Matrix6d covariance = solver.solve(Matrix6d::Identity());
    mount.sigma = covariance.diagonal().cwiseSqrt();
    mount.parameters = covariance.cwiseProduct(normal.H).sum();
    mount.T_truth_cam =
        mount.T_truth_cam.plus(-solver.solve(normal.g + prior * mount.T_truth_cam.log()));
  }
  return mount;
}

}  // namespace placegraph
