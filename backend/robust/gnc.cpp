#include <placegraph/backend/robust/gnc.h>
#include <placegraph/backend/solver/subset_solver.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Weight of a squared error s if errors above `upper` >= gate have no weight.
double weight_of(double s, double gate, double upper, GncSurrogate surrogate) {
  if (surrogate == GncSurrogate::kGemanMcClure) {  // eq. 12, with mu = upper / gate
    const double scale = upper / (upper + s);
    return scale * scale;
  }
  const double lower = gate * gate / upper;  // mu / (mu + 1) * gate
  if (s <= lower) return 1;                  // eq. 14
  if (s >= upper) return 0;
  const double mu = gate / (upper - gate);
  return std::sqrt(gate / s * mu * (mu + 1)) - mu;
}

/// The next, lower threshold: see GncOptions.
double next_threshold(double upper, double gate, const std::vector<double>& loop_chi2,
                      const GncOptions& options) {
  std::vector<double> undecided;
  for (const double s : loop_chi2)
    if (s > gate && s < upper) undecided.push_back(s);
  const double most = upper / options.least_factor;
  if (undecided.empty()) return std::max(gate, most);
  const auto leave =
      static_cast<std::size_t>(options.share_per_round * static_cast<double>(undecided.size()));
  std::nth_element(undecided.begin(), undecided.begin() + static_cast<std::ptrdiff_t>(leave),
                   undecided.end(), std::greater<>());
  return std::max(gate, std::min(most, undecided[leave]));
}

template <class Group>
std::vector<double> chi2_of(const PackedGraph<Group>& graph, const std::vector<int>& loops,
                            RotationError rotation_error) {
  const std::vector<double> all = chi2_by_edge(graph, rotation_error);
  std::vector<double> chi2;
  for (const int loop : loops) chi2.push_back(all[loop]);
  return chi2;
}

}  // namespace

template <class Group>
GncSolution graduated_non_convexity(PackedGraph<Group>& graph, double gate,
                                    const LocalSolverOptions& solver_options,
                                    const GncOptions& options) {
  options.check();
  require(gate > 0, "graduated non-convexity: gate must be positive");
  std::vector<int> loops;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (!graph.edges[i].odometry && graph.edges[i].weight > 0) loops.push_back(static_cast<int>(i));
  for (const int loop : loops) graph.edges[loop].weight = 1;

  LocalSolverOptions rough = solver_options;  // between rounds only the weights matter
  rough.max_iterations = std::min(rough.max_iterations, 10);
  rough.relative_decrease = std::max(rough.relative_decrease, 1e-3);
  SubsetSolver<Group> solver(rough);
  GncSolution result;
  result.local = solver.solve(graph);
  int iterations = result.local.iterations;

  const auto reweight = [&](const std::vector<double>& chi2, auto&& weight) {
    for (std::size_t i = 0; i < loops.size(); ++i) graph.edges[loops[i]].weight = weight(chi2[i]);
  };
  std::vector<double> chi2 = chi2_of(graph, loops, rough.rotation_error);
  double upper = chi2.empty() ? gate : 2 * *std::max_element(chi2.begin(), chi2.end());
  while (upper > gate && result.rounds < options.max_rounds) {
    reweight(chi2, [&](double s) { return weight_of(s, gate, upper, options.surrogate); });
    result.local = solver.solve(graph);
    iterations += result.local.iterations;
    chi2 = chi2_of(graph, loops, rough.rotation_error);
    upper = next_threshold(upper, gate, chi2, options);
    ++result.rounds;
  }
  reweight(chi2, [&](double s) { return s <= gate ? 1.0 : 0.0; });
  result.local = SubsetSolver<Group>(solver_options).solve(graph);
  result.local.iterations += iterations;
  return result;
}

template GncSolution graduated_non_convexity(PackedGraph<SE2>&, double, const LocalSolverOptions&,
                                             const GncOptions&);
template GncSolution graduated_non_convexity(PackedGraph<SE3>&, double, const LocalSolverOptions&,
                                             const GncOptions&);
template GncSolution graduated_non_convexity(PackedGraph<Sim3>&, double, const LocalSolverOptions&,
                                             const GncOptions&);

}  // namespace placegraph
