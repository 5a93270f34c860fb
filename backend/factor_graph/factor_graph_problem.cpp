#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/variable_manifold.h>
#include <placegraph/backend/linear/blas_threads.h>
#include <placegraph/backend/linear/sparse_algebra.h>
#include <placegraph/backend/solver/ceres_factor.h>
#include <placegraph/backend/solver/kernel_loss.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/text/log_message.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <string>

namespace placegraph {
namespace {

/// The values of a term's variables.
std::vector<Variable> values_of(const FactorGraph& graph, const FactorGraph::Term& term) {
  std::vector<Variable> values;
  for (const int i : term.variables)
    values.push_back(graph.variables[static_cast<std::size_t>(i)].value);
  return values;
}

/// One manifold for every kind of variable that needs one.
class Manifolds {
 public:
  ceres::Manifold* of(const Variable& variable) {
    return std::visit(
        [&](const auto& x) -> ceres::Manifold* {
          using T = std::decay_t<decltype(x)>;
          if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Eigen::Vector3d>)
            return nullptr;
          else
            return &std::get<VariableManifold<T>>(manifolds_);
        },
        variable);
  }

 private:
  std::tuple<VariableManifold<SE2>, VariableManifold<SE3>, VariableManifold<Sim3>,
             VariableManifold<SO3>, VariableManifold<Line3>, VariableManifold<Plane3>,
             VariableManifold<Marker>>
      manifolds_;
};

/// Evaluates factors and keeps the first exception, which must not pass through Ceres.
/// After it no factor can be computed, so that the solver ends soon.
class GuardedFactor final : public Factor {
 public:
  GuardedFactor(const Factor& factor, std::exception_ptr& thrown)
      : factor_(factor), thrown_(thrown) {}
  int residual_size() const override { return factor_.residual_size(); }
  std::vector<std::size_t> variable_kinds() const override { return factor_.variable_kinds(); }
  bool evaluate(std::span<const Variable* const> values, Eigen::Ref<Eigen::VectorXd> r,
                std::span<Eigen::MatrixXd> jacobians) const override {
    if (thrown_) return false;
    try {
      check_interruption();
      return factor_.evaluate(values, r, jacobians);
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }

 private:
  const Factor& factor_;
  std::exception_ptr& thrown_;
};

/// A factor graph as a Ceres problem with its own blocks; variables without a term are left out.
class FactorGraphProblem {
 public:
  explicit FactorGraphProblem(const FactorGraph& graph) : graph_(graph), problem_(ownership()) {
    use_one_blas_thread();
    std::size_t size = 0;
    for (const FactorGraph::Node& node : graph.variables) {
      offsets_.push_back(size);
      size += static_cast<std::size_t>(block_size(node.value));
    }
    blocks_.resize(size);
    for (std::size_t i = 0; i < graph.variables.size(); ++i)
      store_block(graph.variables[i].value, &blocks_[offsets_[i]]);
    for (const FactorGraph::Term& term : graph.terms) {
      ceres::LossFunction* loss = nullptr;
      if (term.kernel.kind != RobustKernel::Kind::kNone) loss = &kernels_.emplace_back(term.kernel);
      std::vector<double*> between;
      for (const int i : term.variables) between.push_back(block(i));
      const GuardedFactor& factor = factors_.emplace_back(*term.factor, thrown_);
      problem_.AddResidualBlock(&costs_.emplace_back(factor, values_of(graph, term)), loss,
                                between);
    }
    for (std::size_t i = 0; i < graph.variables.size(); ++i) {
      double* const x = &blocks_[offsets_[i]];
      if (!problem_.HasParameterBlock(x)) continue;
      if (ceres::Manifold* manifold = manifolds_.of(graph.variables[i].value))
        problem_.SetManifold(x, manifold);
      if (graph.variables[i].held)
        problem_.SetParameterBlockConstant(x);
      else
        ++free_;
    }
  }

  int free() const { return free_; }
  /// The exception that ended an evaluation, if any.
  std::exception_ptr& thrown() { return thrown_; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }
  ceres::Problem& problem() { return problem_; }
  double* block(int variable) { return &blocks_[offsets_[static_cast<std::size_t>(variable)]]; }

  void read_back(FactorGraph& graph) const {
    for (std::size_t i = 0; i < graph.variables.size(); ++i) {
      const double* const x = &blocks_[offsets_[i]];
      if (!graph.variables[i].held && problem_.HasParameterBlock(x))
        load_block(x, graph.variables[i].value);
    }
  }

  /// Whether there are many variables without common terms, as the points of a bundle.
  /// Their elimination first leaves a small system.
  bool has_landmarks() const {
    std::size_t landmarks = 0;
    for (const FactorGraph::Node& node : graph_.variables)
      landmarks += std::holds_alternative<Eigen::Vector3d>(node.value) ||
                   std::holds_alternative<Line3>(node.value);
    return 2 * landmarks > graph_.variables.size();
  }

 private:
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  const FactorGraph& graph_;
  std::vector<std::size_t> offsets_;  ///< first number of each variable's block in `blocks_`
  std::vector<double> blocks_;
  std::exception_ptr thrown_;
  std::deque<GuardedFactor> factors_;
  std::deque<DynamicCeresFactor> costs_;
  std::deque<KernelLoss> kernels_;
  Manifolds manifolds_;
  int free_ = 0;
  ceres::Problem problem_;  // declared after all objects that it points to
};

/// Logs every step, and ends the optimization after an exception.
class StepLog final : public ceres::IterationCallback {
 public:
  StepLog(const LogSink& sink, std::exception_ptr& thrown) : sink_(sink), thrown_(thrown) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    try {
      check_interruption();
      if (!thrown_)
        log(sink_, LogLevel::kDebug, "factor graph: step {}, cost {:.9g}", step.iteration,
            step.cost);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    return thrown_ ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const LogSink& sink_;
  std::exception_ptr& thrown_;
};

ceres::Solver::Options solver_options(const FactorGraphOptions& options, bool landmarks) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = landmarks ? ceres::SPARSE_SCHUR : ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = kSparseAlgebra;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.relative_decrease;
  solver.gradient_tolerance = 0;
  solver.parameter_tolerance = 0;
  solver.max_num_consecutive_invalid_steps = 20;
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

FactorGraphReport optimize_factor_graph(const FactorGraph& graph, const FactorGraphOptions& options,
                                        const LogSink& log) {
  options.check();
  graph.check();
  FactorGraphReport report;
  report.graph = graph;
  FactorGraphProblem problem(graph);
  if (problem.free() == 0) {
    report.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      "no term of the graph has a variable that may move");
    return report;
  }
  ceres::Solver::Summary summary;
  StepLog steps(log, problem.thrown());
  ceres::Solver::Options solver = solver_options(options, problem.has_landmarks());
  solver.callbacks.push_back(&steps);
  ceres::Solve(solver, &problem.problem(), &summary);
  problem.rethrow();
  report.cost_initial = summary.initial_cost;
  report.cost_final = summary.final_cost;
  report.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  if (summary.IsSolutionUsable()) problem.read_back(report.graph);
  report.outcome = summary.termination_type == ceres::CONVERGENCE
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kNotConverged, summary.message);
  return report;
}

MarginalCovariance marginal_covariance(const FactorGraph& graph,
                                       const std::vector<int>& variables) {
  graph.check();
  require(!variables.empty(), "marginal covariance: no variable is named");
  MarginalCovariance result;
  FactorGraphProblem problem(graph);
  std::vector<const double*> blocks;
  Eigen::Index size = 0;
  for (const int i : variables) {
    const std::string name = "marginal covariance: variable " + std::to_string(i);
    require(i >= 0 && static_cast<std::size_t>(i) < graph.variables.size(), name + " is not there");
    const FactorGraph::Node& node = graph.variables[static_cast<std::size_t>(i)];
    require(!node.held, name + " is held");
    double* const block = problem.block(i);
    require(std::find(blocks.begin(), blocks.end(), block) == blocks.end(), name + " repeats");
    blocks.push_back(block);
    size += degrees_of_freedom(node.value);
    if (!problem.problem().HasParameterBlock(block)) {
      result.outcome = Outcome::failure(Outcome::Code::kDegenerate, name + " has no term");
      return result;
    }
  }
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.sparse_linear_algebra_library_type = kSparseAlgebra;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  result.covariance.resize(size, size);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor matrix(size, size);
  const bool computed = covariance.Compute(blocks, &problem.problem());
  problem.rethrow();
  if (!computed || !covariance.GetCovarianceMatrixInTangentSpace(blocks, matrix.data()) ||
      !matrix.allFinite()) {
    result.covariance.setZero();
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                      "the terms leave some direction of the graph undetermined");
    return result;
  }
  result.covariance = matrix;
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
