#include <ceres/problem.h>
#include <ceres/solver.h>
#include <placegraph/backend/factors/position.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/linear/sparse_algebra.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/solver/ceres_factor.h>
#include <placegraph/backend/solver/ceres_solver.h>
#include <placegraph/backend/solver/kernel_loss.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/text/log_message.h>

#include <algorithm>
#include <deque>
#include <exception>

namespace placegraph {
namespace {

/// A packed graph as a Ceres problem with its own pose blocks.
template <class Group>
class GraphProblem {
 public:
  static constexpr int kSize = VariableBlock<Group>::kSize;

  GraphProblem(const PackedGraph<Group>& graph, RotationError rotation_error)
      : poses_(graph.poses.size() * kSize), problem_(ownership()) {
    for (std::size_t i = 0; i < graph.poses.size(); ++i)
      VariableBlock<Group>::store(graph.poses[i], &poses_[i * kSize]);
    for (const auto& edge : graph.edges) {
      if (edge.weight == 0) continue;
      problem_.AddResidualBlock(
          new CeresFactor<RelativePoseFactor<Group>>(RelativePoseFactor<Group>(
              edge.T_to_from.inverse(), whitening(edge.information, &deficient_), rotation_error)),
          loss(edge.kernel, edge.weight), block(edge.from), block(edge.to));
    }
    for (const auto& position : graph.positions) {
      if (position.weight == 0) continue;
      deficient_ = true;
      problem_.AddResidualBlock(new CeresFactor<PositionFactor<Group>>(PositionFactor<Group>(
                                    position.position_world, position.lever_arm,
                                    whitening(position.information, &deficient_))),
                                loss(position.kernel, position.weight), block(position.node));
    }
    for (std::size_t i = 0; i < graph.poses.size(); ++i) {
      double* const pose = &poses_[i * kSize];
      if (!problem_.HasParameterBlock(pose)) continue;
      problem_.SetManifold(pose, &manifold_);
      if (graph.components.held[i]) problem_.SetParameterBlockConstant(pose);
    }
  }

  ceres::Problem& problem() { return problem_; }
  /// Whether a constraint leaves directions undetermined; the normal equations may be singular
  /// then.
  bool deficient() const { return deficient_; }
  /// Writes back the poses of the nodes that were free.
  void read_back(PackedGraph<Group>& graph) const {
    for (std::size_t i = 0; i < graph.poses.size(); ++i) {
      const double* const pose = &poses_[i * kSize];
      if (problem_.HasParameterBlock(pose) && !problem_.IsParameterBlockConstant(pose))
        graph.poses[i] = VariableBlock<Group>::load(pose);
    }
  }

 private:
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }
  double* block(int node) { return &poses_[static_cast<std::size_t>(node) * kSize]; }
  ceres::LossFunction* loss(const RobustKernel& kernel, double weight) {
    ceres::LossFunction* loss = nullptr;
    if (kernel.kind != RobustKernel::Kind::kNone) loss = &kernels_.emplace_back(kernel);
    if (weight != 1) loss = &scales_.emplace_back(loss, weight, ceres::DO_NOT_TAKE_OWNERSHIP);
    return loss;
  }

  std::vector<double> poses_;
  VariableManifold<Group> manifold_;
  std::deque<KernelLoss> kernels_;
  std::deque<ceres::ScaledLoss> scales_;
  bool deficient_ = false;
  ceres::Problem problem_;  // declared after all objects that it points to
};

/// Logs every step, and ends the optimization after an exception, which must not pass through
/// Ceres.
class IterationLog final : public ceres::IterationCallback {
 public:
  explicit IterationLog(const LogSink& sink) : sink_(sink) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    try {
      check_interruption();
      log(sink_, LogLevel::kDebug, "iteration {}: cost {:f}", step.iteration, 2 * step.cost);
      return ceres::SOLVER_CONTINUE;
    } catch (...) {
      thrown_ = std::current_exception();
      return ceres::SOLVER_ABORT;
    }
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  const LogSink& sink_;
  std::exception_ptr thrown_;
};

ceres::Solver::Options solver_options(const LocalSolverOptions& options, bool deficient) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = kSparseAlgebra;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.relative_decrease;
  solver.gradient_tolerance = 0;
  solver.parameter_tolerance = 0;
  // Nearly Gauss-Newton in the first steps: on published graphs it takes half the iterations of the
  // usual damping and reaches the same minima. If directions may be undetermined, damping is
  // required against diverging first steps along them.
  solver.initial_trust_region_radius = deficient ? 1e4 : 1e10;
  solver.max_num_consecutive_invalid_steps = 20;
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

template <class Group>
LocalSolution solve_with_ceres(PackedGraph<Group>& graph, const LocalSolverOptions& options) {
  GraphProblem<Group> problem(graph, options.rotation_error);
  ceres::Solver::Summary summary;
  IterationLog steps(options.log);
  ceres::Solver::Options solver = solver_options(options, problem.deficient());
  solver.callbacks.push_back(&steps);
  ceres::Solve(solver, &problem.problem(), &summary);
  steps.rethrow();
  LocalSolution solution;
  solution.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  solution.cost_initial = 2 * summary.initial_cost;
  solution.cost_final = 2 * summary.final_cost;
  if (summary.IsSolutionUsable()) problem.read_back(graph);
  solution.outcome = summary.termination_type == ceres::CONVERGENCE
                         ? Outcome::ok()
                         : Outcome::failure(Outcome::Code::kNotConverged, summary.message);
  return solution;
}

template LocalSolution solve_with_ceres(PackedGraph<SE2>&, const LocalSolverOptions&);
template LocalSolution solve_with_ceres(PackedGraph<SE3>&, const LocalSolverOptions&);
template LocalSolution solve_with_ceres(PackedGraph<Sim3>&, const LocalSolverOptions&);

}  // namespace placegraph
