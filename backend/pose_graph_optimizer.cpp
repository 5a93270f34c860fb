#include <ceres/problem.h>
#include <ceres/solver.h>
#include <placegraph/backend/blas_threads.h>
#include <placegraph/backend/factors/kernel_loss.h>
#include <placegraph/backend/factors/position.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/pose_graph_optimizer.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <set>

namespace placegraph {
namespace {

/// W with W^T W = information, for information of any rank (rows of directions without information
/// are zero). `deficient` is set where the rank is not full.
template <class Matrix>
Matrix whitening(const Matrix& information, bool& deficient) {
  const Eigen::LLT<Matrix> llt(information);
  if (llt.info() == Eigen::Success) {
    const auto pivots = llt.matrixLLT().diagonal();
    deficient |= pivots.minCoeff() < 1e-6 * pivots.maxCoeff();
    return llt.matrixU();
  }
  deficient = true;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(information);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// e^T Omega e of one constraint.
template <class Group>
double chi2_of(const PoseGraph& graph, const std::unordered_map<std::int64_t, int>& index,
               const Constraint& constraint, RotationError rotation_error) {
  const auto pose = [&](std::int64_t id) -> const Group& {
    return std::get<Group>(graph.nodes[static_cast<std::size_t>(index.at(id))].T_world_node);
  };
  if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraint)) {
    const Group E = std::get<Group>(relative->T_from_to).inverse() *
                    (pose(relative->from).inverse() * pose(relative->to));
    const typename Group::Tangent e = pose_error(E, rotation_error);
    return e.dot(relative->information * e);
  }
  const auto& position = std::get<PositionConstraint>(constraint);
  const Eigen::Vector3d e =
      PositionFactor<Group>::error(pose(position.node), position.position_world);
  return e.dot(position.information * e);
}

template <class Group>
std::vector<double> chi2_of_all(const PoseGraph& graph, RotationError rotation_error) {
  const std::unordered_map<std::int64_t, int> index = graph.index_by_id();
  std::vector<double> chi2_by_constraint;
  chi2_by_constraint.reserve(graph.constraints.size());
  for (const Constraint& constraint : graph.constraints)
    chi2_by_constraint.push_back(chi2_of<Group>(graph, index, constraint, rotation_error));
  return chi2_by_constraint;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// Which nodes are held: the fixed ones, and the first of every component that neither a fixed node
/// nor a measured position ties to the world.
std::vector<bool> held_nodes(const PoseGraph& graph,
                             const std::unordered_map<std::int64_t, int>& index) {
  const std::vector<int> component = graph.components();
  std::vector<bool> held(graph.nodes.size());
  std::set<int> anchored;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    held[i] = graph.nodes[i].fixed;
    if (held[i]) anchored.insert(component[i]);
  }
  for (const Constraint& constraint : graph.constraints)
    if (const auto* position = std::get_if<PositionConstraint>(&constraint))
      anchored.insert(component[static_cast<std::size_t>(index.at(position->node))]);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (anchored.insert(component[i]).second) held[i] = true;
  return held;
}

/// The graph as a Ceres problem over the blocks of `poses`.
template <class Group>
class GraphProblem {
 public:
  static constexpr int kSize = PoseBlock<Group>::kSize;

  GraphProblem(const PoseGraph& graph, RotationError rotation_error)
      : index_(graph.index_by_id()), poses_(graph.nodes.size() * kSize), problem_(ownership()) {
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
      PoseBlock<Group>::store(std::get<Group>(graph.nodes[i].T_world_node), &poses_[i * kSize]);
    for (const Constraint& constraint : graph.constraints) {
      if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraint)) {
        const typename Group::Jacobian information = relative->information;
        problem_.AddResidualBlock(
            new RelativePoseFactor<Group>(std::get<Group>(relative->T_from_to),
                                          whitening(information, deficient_), rotation_error),
            loss(relative->kernel), block(relative->from), block(relative->to));
      } else {
        deficient_ = true;
        const auto& position = std::get<PositionConstraint>(constraint);
        problem_.AddResidualBlock(
            new PositionFactor<Group>(position.position_world,
                                      whitening(position.information, deficient_)),
            loss(position.kernel), block(position.node));
      }
    }
    const std::vector<bool> held = held_nodes(graph, index_);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      double* const pose = &poses_[i * kSize];
      if (!problem_.HasParameterBlock(pose)) continue;
      problem_.SetManifold(pose, &manifold_);
      if (held[i]) problem_.SetParameterBlockConstant(pose);
    }
  }

  ceres::Problem& problem() { return problem_; }
  /// Whether some constraint leaves directions open: the normal equations may be singular then.
  bool deficient() const { return deficient_; }
  /// Writes the poses of the nodes the problem could move.
  void read_back(PoseGraph& graph) const {
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      const double* const pose = &poses_[i * kSize];
      if (problem_.HasParameterBlock(pose) && !problem_.IsParameterBlockConstant(pose))
        graph.nodes[i].T_world_node = PoseBlock<Group>::load(pose);
    }
  }

 private:
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }
  double* block(std::int64_t id) {
    return &poses_[static_cast<std::size_t>(index_.at(id)) * kSize];
  }
  ceres::LossFunction* loss(const RobustKernel& kernel) {
    if (kernel.kind == RobustKernel::Kind::kNone) return nullptr;
    return &losses_.emplace_back(kernel);
  }

  std::unordered_map<std::int64_t, int> index_;
  std::vector<double> poses_;
  PoseManifold<Group> manifold_;
  std::deque<KernelLoss> losses_;
  bool deficient_ = false;
  ceres::Problem problem_;  // after what it points to
};

ceres::Solver::Options solver_options(const PoseGraphOptions& options, bool deficient) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.relative_decrease;
  solver.gradient_tolerance = 0;
  solver.parameter_tolerance = 0;
  // Nearly Gauss-Newton at first: measured on published graphs it takes half the iterations of the
  // usual damping and reaches the same minima. Where directions may be open, only damping keeps
  // the first steps from running away along them.
  solver.initial_trust_region_radius = deficient ? 1e4 : 1e10;
  solver.max_num_consecutive_invalid_steps = 20;
  solver.logging_type = ceres::SILENT;
  return solver;
}

template <class Group>
PoseGraphReport optimize(const PoseGraph& graph, const PoseGraphOptions& options,
                         const LogSink& log_sink) {
  PoseGraphReport report;
  report.graph = graph;
  report.chi2_by_constraint = chi2_of_all<Group>(graph, options.rotation_error);
  report.chi2_initial = report.chi2_final = sum(report.chi2_by_constraint);

  GraphProblem<Group> problem(graph, options.rotation_error);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(options, problem.deficient()), &problem.problem(), &summary);
  report.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  if (summary.IsSolutionUsable()) {
    problem.read_back(report.graph);
    report.chi2_by_constraint = chi2_of_all<Group>(report.graph, options.rotation_error);
    report.chi2_final = sum(report.chi2_by_constraint);
  }
  report.outcome = summary.termination_type == ceres::CONVERGENCE
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kNotConverged, summary.message);
  log(log_sink, LogLevel::kInfo,
      "pose graph: chi2 " + std::to_string(report.chi2_initial) + " -> " +
          std::to_string(report.chi2_final) + " in " + std::to_string(report.iterations) +
          " iterations");
  return report;
}

}  // namespace

void PoseGraphOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PoseGraphOptions& o) {
  field.choice("rotation_error", o.rotation_error, {"log", "quaternion"},
               "error of a relative pose: log of the group, or g2o's quaternion vector part");
  field("max_iterations", o.max_iterations, "steps of Levenberg-Marquardt", {1, 100000});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost falls by less than this share", {0, 1});
}

PoseGraphReport optimize_pose_graph(const PoseGraph& graph, const PoseGraphOptions& options,
                                    const LogSink& log) {
  options.check();
  graph.check();
  use_one_blas_thread();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return optimize<SE2>(graph, options, log);
    case PoseKind::kSE3:
      return optimize<SE3>(graph, options, log);
    case PoseKind::kSim3:
      break;
  }
  return optimize<Sim3>(graph, options, log);
}

double chi2(const PoseGraph& graph, RotationError rotation_error) {
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return sum(chi2_of_all<SE2>(graph, rotation_error));
    case PoseKind::kSE3:
      return sum(chi2_of_all<SE3>(graph, rotation_error));
    case PoseKind::kSim3:
      break;
  }
  return sum(chi2_of_all<Sim3>(graph, rotation_error));
}

}  // namespace placegraph
