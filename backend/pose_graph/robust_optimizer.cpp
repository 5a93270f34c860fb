#include <placegraph/backend/pose_graph/initialization_selection.h>
#include <placegraph/backend/pose_graph/robust_optimizer.h>
#include <placegraph/backend/robust/parallel_odometry.h>
#include <placegraph/backend/robust/pcm.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/text/log_message.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace placegraph {
namespace {

template <class Group>
LocalSolution solve_with_kernel(PackedGraph<Group>& graph, const RobustKernel& kernel,
                                const LocalSolverOptions& solver) {
  for (auto& edge : graph.edges)
    if (!edge.odometry) edge.kernel = kernel;
  return LocalSolver<Group>(solver).solve(graph);
}

/// Whether the errors at a plain minimum show that all loops are true.
/// The noise must be near that of the rings of neighbouring loops, and no loop may be an outlier.
template <class Group>
bool beyond_doubt(const PackedGraph<Group>& graph, double ring_scale, const RobustOptions& options,
                  RotationError rotation_error) {
  constexpr double kDrift = 10;  // ratio of the noise of long rings to that of short ones
  constexpr double kTail = 10;   // ratio of the largest error of true loops to their 99 % quantile
  const std::vector<double> chi2 = chi2_by_edge(graph, rotation_error);
  const int redundant = graph.components.redundant;
  if (redundant == 0) return true;
  const double scale = std::accumulate(chi2.begin(), chi2.end(), 0.0) / (Group::kDof * redundant);
  std::vector<double> loops;
  for (std::size_t i = 0; i < chi2.size(); ++i)
    if (!graph.edges[i].odometry) loops.push_back(chi2[i]);
  std::sort(loops.begin(), loops.end());
  const double usual =
      loops[static_cast<std::size_t>(0.99 * static_cast<double>(loops.size() - 1))];
  const double gate =
      options.growth.margin * scale * chi_squared_quantile(options.gate_probability, Group::kDof);
  return scale <= kDrift * ring_scale && loops.back() <= std::max(gate, kTail * usual);
}

/// Sets the poses by the odometry, if odometry connects them all.
template <class Group>
void initialize_from_odometry(PackedGraph<Group>& graph, const OdometryChain<Group>& chain) {
  const std::vector<char>& is_held = graph.components.held;
  if (chain.runs() != 1 || std::count(is_held.begin(), is_held.end(), 1) != 1 ||
      !graph.positions.empty())
    return;
  const auto held = std::find(is_held.begin(), is_held.end(), 1) - is_held.begin();
  const Group T_world_first = graph.poses[held] * chain.pose(static_cast<int>(held)).inverse();
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!is_held[i]) graph.poses[i] = T_world_first * chain.pose(static_cast<int>(i));
}

/// Initializes the plain descent: with the given poses, or with the chordal initialization if the
/// given poses are rough and its cost is lower.
template <class Group>
void initialize_plain(PackedGraph<Group>& graph, RotationError rotation_error) {
  constexpr double kRough = 0.5;  // [rad]
  constexpr int dim = Group::kDof == 3 ? 2 : 3, rotations = dim == 2 ? 1 : 3;
  const bool rough = std::any_of(graph.edges.begin(), graph.edges.end(), [&](const auto& edge) {
    const typename Group::Tangent e =
        (edge.T_to_from * (graph.poses[edge.from].inverse() * graph.poses[edge.to])).log();
    return e.template segment<rotations>(dim).norm() > kRough;
  });
  if (!rough || !graph.positions.empty()) return;
  PackedGraph<Group> chordal = graph;
  set_initialization(chordal, PoseGraphInitialization::kChordal, rotation_error);
  const auto cost = [&](const PackedGraph<Group>& at) {
    const std::vector<double> chi2 = chi2_by_edge(at, rotation_error);
    return std::accumulate(chi2.begin(), chi2.end(), 0.0);
  };
  if (cost(chordal) < cost(graph)) graph.poses = std::move(chordal.poses);
}

/// Largest squared error of a loop that noise of this scale explains.
template <class Group>
double gate_of(double noise_scale, const RobustOptions& options) {
  return options.growth.margin * noise_scale *
         chi_squared_quantile(options.gate_probability, Group::kDof);
}

/// Loop set growth from the largest sets of loops that agree in pairs with the odometry.
template <class Group>
RobustSolution solve_pcm(PackedGraph<Group>& graph, const OdometryChain<Group>& chain,
                         const LoopSupport& support, const LocalSolverOptions& solver,
                         const RobustOptions& options) {
  LoopSupport sets = support;
  sets.clusters = consistent_loops(graph, chain, gate_of<Group>(support.noise_scale, options));
  initialize_from_odometry(graph, chain);
  const LoopSetGrowth growth =
      extend_loop_set(graph, sets, options.gate_probability, solver, options.growth, options.gnc);
  RobustSolution result;
  result.local = growth.local;
  result.noise_scale = growth.noise_scale;
  return result;
}

/// Whether most of the rejected loops support each other in large groups, or the accepted ones need
/// far more noise than the rings of neighbouring loops: of the sets of loops that agree among
/// themselves, a false one may have been accepted.
template <class Group>
bool contested(const PackedGraph<Group>& graph, const LoopSupport& support,
               const RobustSolution& solution) {
  // Noise over that of the rings. Chosen: an order of magnitude.
  constexpr double kFarMore = 10;
  constexpr std::ptrdiff_t kLarge = 10;  // loops; fewer agree by chance
  if (!solution.local.outcome || solution.noise_scale > kFarMore * support.noise_scale) return true;
  std::ptrdiff_t all = 0, in_large_groups = 0;
  for (const auto& cluster : support.clusters) {
    const auto rejected = std::count_if(cluster.begin(), cluster.end(),
                                        [&](int edge) { return graph.edges[edge].weight == 0; });
    all += rejected;
    if (rejected >= kLarge) in_large_groups += rejected;
  }
  return 2 * in_large_groups > all;
}

/// The cost that graduated non-convexity minimizes: a loop counts at most `gate`.
template <class Group>
double truncated_cost(const PackedGraph<Group>& graph, double gate, RotationError rotation_error) {
  const std::vector<double> chi2 = chi2_by_edge(graph, rotation_error);
  double cost = 0;
  for (std::size_t i = 0; i < chi2.size(); ++i)
    cost += graph.edges[i].odometry ? chi2[i] : std::min(chi2[i], gate);
  return cost;
}

/// Replaces a solution by that of the loops which agree with the odometry in pairs, from the poses
/// `given`, if its truncated cost is lower. A group of false loops can bend the odometry until its
/// own loops fit: the minimum that is found then is far from the lowest.
template <class Group>
void try_consistent_loops(const PackedGraph<Group>& given, const OdometryChain<Group>& chain,
                          const LoopSupport& support, const LocalSolverOptions& solver,
                          const RobustOptions& options, PackedGraph<Group>& graph,
                          RobustSolution& solution) {
  constexpr std::size_t kMostLoops = 10'000;  // every pair of loops is compared
  // A cost that is lower by more than rounding. Chosen: a millionth.
  constexpr double kLower = 1 - 1e-6;
  if (support.loops() > kMostLoops) return;
  const double gate = gate_of<Group>(support.noise_scale, options);
  PackedGraph<Group> other = given;
  RobustSolution second = solve_pcm(other, chain, support, solver, options);
  const int iterations = solution.local.iterations + second.local.iterations;
  const bool lower = truncated_cost(other, gate, solver.rotation_error) <
                     kLower * truncated_cost(graph, gate, solver.rotation_error);
  if (second.local.outcome && (lower || !solution.local.outcome)) {
    graph = std::move(other);
    solution = std::move(second);
  }
  solution.local.iterations = iterations;
}

template <class Group>
RobustSolution solve_gnc(PackedGraph<Group>& graph, const OdometryChain<Group>& chain,
                         const LoopSupport& support, const LocalSolverOptions& solver,
                         const RobustOptions& options) {
  const PackedGraph<Group> given = graph;
  (void)graduated_non_convexity(graph, gate_of<Group>(support.noise_scale, options), solver,
                                options.gnc);
  const LoopSetGrowth settled =
      settle_loops(graph, support, options.gate_probability, solver, options.growth, options.gnc);
  RobustSolution result;
  result.local = settled.local;
  result.noise_scale = settled.noise_scale;
  try_consistent_loops(given, chain, support, solver, options, graph, result);
  return result;
}

template <class Group>
RobustSolution solve_auto(PackedGraph<Group>& graph, const OdometryChain<Group>& chain,
                          const LoopSupport& support, const LocalSolverOptions& solver,
                          const RobustOptions& options, bool free_start) {
  // If many loops have no support, many are false, and the plain minimum is not computed.
  constexpr double kManyAlone = 0.05;
  const std::size_t loops = support.loops();
  RobustSolution result;
  PackedGraph<Group> plain = graph;
  const bool tried = support.alone <= kManyAlone * static_cast<double>(loops) || loops < 50;
  if (tried) {
    // Without false loops a few steps suffice; with false loops the minimum is far away and
    // useless.
    constexpr int kSteps = 20;
    LocalSolverOptions short_solver = solver;
    short_solver.max_iterations = std::min(solver.max_iterations, kSteps);
    if (free_start) initialize_plain(plain, solver.rotation_error);
    result.local = LocalSolver<Group>(short_solver).solve(plain);
    if (loops == 0 || (result.local.outcome &&
                       beyond_doubt(plain, support.noise_scale, options, solver.rotation_error))) {
      graph = std::move(plain);
      return result;
    }
  }
  const PackedGraph<Group> given = graph;
  initialize_from_odometry(graph, chain);
  const LoopSetGrowth growth = extend_loop_set(graph, support, options.gate_probability, solver,
                                               options.growth, options.gnc);
  result.noise_scale = growth.noise_scale;
  const bool all = std::all_of(graph.edges.begin(), graph.edges.end(),
                               [](const auto& edge) { return edge.weight > 0; });
  // No loop was false: the plain minimum is used if it is the same.
  constexpr double kSameCost = 1 + 1e-6;
  if (all && tried && result.local.outcome &&
      result.local.cost_final <= growth.local.cost_final * kSameCost)
    graph = std::move(plain);
  else
    result.local = growth.local;
  if (contested(graph, support, result))
    try_consistent_loops(given, chain, support, solver, options, graph, result);
  return result;
}

template <class Group>
std::vector<RejectedEdge> edges_without_weight(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain,
                                               const LoopSupport& support, double gate,
                                               RotationError rotation_error) {
  std::vector<RejectedEdge> rejected;
  std::vector<char> alone(graph.edges.size(), false);
  for (const auto& cluster : support.clusters)
    if (cluster.size() == 1) alone[cluster.front()] = true;
  const std::vector<double> chi2 = chi2_by_edge(graph, rotation_error);
  for (const LoopOnChain<Group>& loop : loops_on_chain(graph, chain)) {
    const auto& edge = graph.edges[loop.edge];
    if (edge.weight > 0) continue;
    const char* reason = "residual";
    if (chain.run(loop.from) == chain.run(loop.to) && drift_misclosure(loop, chain).chi2 > gate)
      reason = "inconsistent with odometry";
    else if (alone[loop.edge])
      reason = "pairwise";
    rejected.push_back({edge.constraint, chi2[loop.edge], reason});
  }
  std::sort(rejected.begin(), rejected.end(),
            [](const auto& a, const auto& b) { return a.constraint < b.constraint; });
  return rejected;
}

/// Optimizes by one of the methods that leave loops out.
template <class Group>
RobustSolution solve_rejecting(PackedGraph<Group>& graph, const LocalSolverOptions& solver,
                               const RobustOptions& options, bool free_start) {
  const OdometryChain<Group> chain(graph);
  const LoopSupport support = support_loops(graph, chain, options.support);
  RobustSolution result;
  if (!support.clusters.empty() && !support.scale_is_known) {
    result.judged = false;
    result.local = LocalSolver<Group>(solver).solve(graph);
    return result;
  }
  if (options.method == RobustMethod::kPcm)
    result = solve_pcm(graph, chain, support, solver, options);
  else if (options.method == RobustMethod::kGnc)
    result = solve_gnc(graph, chain, support, solver, options);
  else
    result = solve_auto(graph, chain, support, solver, options, free_start);
  result.rejected = edges_without_weight(
      graph, chain, support, gate_of<Group>(result.noise_scale, options), solver.rotation_error);
  return result;
}

}  // namespace

template <class Group>
RobustSolution solve_robustly(PackedGraph<Group>& graph, const LocalSolverOptions& solver,
                              const RobustOptions& options, bool free_start) {
  options.check();
  RobustSolution result;
  if (options.method != RobustMethod::kNone) set_parallel_odometry_apart(graph, options.support);
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
    case RobustMethod::kPcm:
    case RobustMethod::kAuto:
      result = solve_rejecting(graph, solver, options, free_start);
      break;
  }
  if (!result.rejected.empty())
    log(solver.log, LogLevel::kInfo, "pose graph: {} edges left out as false",
        result.rejected.size());
  return result;
}

template RobustSolution solve_robustly(PackedGraph<SE2>&, const LocalSolverOptions&,
                                       const RobustOptions&, bool);
template RobustSolution solve_robustly(PackedGraph<SE3>&, const LocalSolverOptions&,
                                       const RobustOptions&, bool);
template RobustSolution solve_robustly(PackedGraph<Sim3>&, const LocalSolverOptions&,
                                       const RobustOptions&, bool);

}  // namespace placegraph
