#include <placegraph/backend/chi_squared.h>
#include <placegraph/backend/robust_optimizer.h>

namespace placegraph {
namespace {

template <class Group>
LocalSolution solve_with_kernel(PackedGraph<Group>& graph, const RobustKernel& kernel,
                                const LocalSolverOptions& solver) {
  for (auto& edge : graph.edges)
    if (!edge.odometry) edge.kernel = kernel;
  return LocalSolver<Group>(solver).solve(graph);
}

template <class Group>
std::vector<RejectedEdge> edges_without_weight(const PackedGraph<Group>& graph,
                                               RotationError rotation_error) {
  std::vector<RejectedEdge> rejected;
  const std::vector<double> chi2 = chi2_by_edge(graph, rotation_error);
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (graph.edges[i].weight == 0)
      rejected.push_back({graph.edges[i].constraint, chi2[i], "residual"});
  return rejected;
}

}  // namespace

void RobustOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RobustOptions& o) {
  field.choice("method", o.method, {"none", "huber", "dcs", "gnc"},
               "what is done against false loops; none: the kernels the constraints carry");
  field("kernel_width", o.kernel_width, "of huber and dcs, in standard deviations", {1e-9, 1e9});
  field("gate_probability", o.gate_probability,
        "share of the true loops whose squared error lies below the gate, were noise Gaussian",
        {0.5, 0.999999});
  field.group("gnc", o.gnc, "graduated non-convexity");
}

template <class Group>
RobustSolution solve_robustly(PackedGraph<Group>& graph, const LocalSolverOptions& solver,
                              const RobustOptions& options) {
  options.check();
  RobustSolution result;
  switch (options.method) {
    case RobustMethod::kNone:
      result.local = LocalSolver<Group>(solver).solve(graph);
      break;
    case RobustMethod::kHuber:
      result.local =
          solve_with_kernel(graph, {RobustKernel::Kind::kHuber, options.kernel_width}, solver);
      break;
    case RobustMethod::kDcs:
      result.local =
          solve_with_kernel(graph, {RobustKernel::Kind::kDcs, options.kernel_width}, solver);
      break;
    case RobustMethod::kGnc:
      result.local = graduated_non_convexity(
                         graph, chi_squared_quantile(options.gate_probability, Group::kDof), solver,
                         options.gnc)
                         .local;
      break;
  }
  result.rejected = edges_without_weight(graph, solver.rotation_error);
  if (!result.rejected.empty())
    log(solver.log, LogLevel::kInfo,
        "pose graph: " + std::to_string(result.rejected.size()) + " edges left out as false");
  return result;
}

template RobustSolution solve_robustly(PackedGraph<SE2>&, const LocalSolverOptions&,
                                       const RobustOptions&);
template RobustSolution solve_robustly(PackedGraph<SE3>&, const LocalSolverOptions&,
                                       const RobustOptions&);
template RobustSolution solve_robustly(PackedGraph<Sim3>&, const LocalSolverOptions&,
                                       const RobustOptions&);

}  // namespace placegraph
