#include <placegraph/backend/georeference/variance_components.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/backend/solver/odometry_chain.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// Redundancy without which a component keeps its factor. Chosen.
constexpr double kLeastRedundancy = 0.5;
constexpr double kSmallest = 1e-3, kLargest = 1e3;  ///< bounds of a factor in one step

struct Component {
  double squares = 0, redundancy = 0;
  /// Adds an edge: its stated and remaining covariance and its error in these directions.
  void add(const Eigen::MatrixXd& claimed, const Eigen::MatrixXd& remaining,
           const Eigen::VectorXd& e) {
    const Eigen::LLT<Eigen::MatrixXd> factor(claimed);
    squares += e.dot(factor.solve(e));
    redundancy += static_cast<double>(e.size()) - factor.solve(remaining).trace();
  }
  DispersionFactor factor() const {
    DispersionFactor result;
    result.redundancy = redundancy;
    if (!(redundancy >= kLeastRedundancy)) return result;
    const double ratio = squares / redundancy, spread = 2 / (9 * redundancy);
    result.factor = std::clamp(std::sqrt(ratio), kSmallest, kLargest);
    result.deviations = (std::cbrt(ratio) - (1 - spread)) / std::sqrt(spread);
    return result;
  }
};

/// The edges whose dispersion is estimated.
std::vector<int> judged(const PoseGraph& graph) {
  std::vector<int> odometry, all;
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&graph.constraints[i]);
    if (!edge) continue;
    all.push_back(static_cast<int>(i));
    if (edge->source == ConstraintSource::kOdometry) odometry.push_back(static_cast<int>(i));
  }
  return odometry.empty() ? all : odometry;
}

template <class Group>
VarianceComponents estimate_components(const PoseGraph& graph) {
  constexpr int dim = Group::kDof == 3 ? 2 : 3, rotations = Group::kDof - dim;
  const PoseMarginals marginals(graph);
  VarianceComponents result;
  if (!marginals.outcome()) return result;
  const auto covariances = marginals.constraint_covariances();
  const auto index = graph.index_by_id();
  Component translation, rotation;
  for (const int i : judged(graph)) {
    const auto& edge = std::get<RelativePoseConstraint>(graph.constraints[i]);
    const auto pose = [&](NodeId id) {
      return std::get<Group>(graph.nodes[static_cast<std::size_t>(index.at(id))].T_world_node);
    };
    const typename Group::Tangent e =
        (std::get<Group>(edge.T_from_to).inverse() * (pose(edge.from).inverse() * pose(edge.to)))
            .log();
    const typename Group::Jacobian claimed =
        covariance_of(typename Group::Jacobian(edge.information));
    translation.add(claimed.template topLeftCorner<dim, dim>(),
                    covariances[i].topLeftCorner(dim, dim), e.template head<dim>());
    rotation.add(claimed.template bottomRightCorner<rotations, rotations>(),
                 covariances[i].bottomRightCorner(rotations, rotations),
                 e.template tail<rotations>());
  }
  result.translation = translation.factor();
  result.rotation = rotation.factor();
  return result;
}

template <class Group>
ClaimedDrift drift(const PoseGraph& map) {
  constexpr int dim = Group::kDof == 3 ? 2 : 3, rotations = dim == 2 ? 1 : 3;
  typename Group::Point mean = Group::Point::Zero();
  double squares = 0;
  for (const PoseNode& node : map.nodes) {
    const typename Group::Point p = std::get<Group>(node.T_world_node).translation();
    mean += p;
    squares += p.squaredNorm();
  }
  const auto n = static_cast<double>(map.nodes.size());
  const double radius = std::sqrt(std::max(0.0, squares / n - (mean / n).squaredNorm()));
  double translation = 0, rotation = 0;
  for (const int i : judged(map)) {
    const auto& edge = std::get<RelativePoseConstraint>(map.constraints[i]);
    const typename Group::Jacobian claimed =
        covariance_of(typename Group::Jacobian(edge.information));
    translation += claimed.template topLeftCorner<dim, dim>().trace();
    rotation += claimed.template block<rotations, rotations>(dim, dim).trace();
  }
  return {std::sqrt(translation), radius * std::sqrt(rotation)};
}

}  // namespace

VarianceComponents odometry_variance_components(const PoseGraph& solved) {
  switch (solved.kind()) {
    case PoseKind::kSE2:
      return estimate_components<SE2>(solved);
    case PoseKind::kSE3:
      return estimate_components<SE3>(solved);
    case PoseKind::kSim3:
      break;
  }
  return estimate_components<Sim3>(solved);
}

ClaimedDrift claimed_drift(const PoseGraph& map) {
  switch (map.kind()) {
    case PoseKind::kSE2:
      return drift<SE2>(map);
    case PoseKind::kSE3:
      return drift<SE3>(map);
    case PoseKind::kSim3:
      break;
  }
  return drift<Sim3>(map);
}

void scale_odometry(PoseGraph& graph, double translation_factor, double rotation_factor) {
  for (Constraint& constraint : graph.constraints) {
    auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (!edge) continue;
    const Eigen::Index dof = edge->information.rows(), dim = dof == 3 ? 2 : 3;
    Eigen::VectorXd inverse = Eigen::VectorXd::Constant(dof, 1 / rotation_factor);
    inverse.head(dim).setConstant(1 / translation_factor);
    edge->information =
        Information(inverse.asDiagonal() * edge->information * inverse.asDiagonal());
  }
}

}  // namespace placegraph
