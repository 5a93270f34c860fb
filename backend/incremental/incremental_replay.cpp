#include <placegraph/backend/incremental/incremental_replay.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace placegraph {
namespace {

/// CPU time of this thread [ms].
double thread_cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

struct Steps {
  std::vector<int> nodes;                     ///< positions, in the order of their ids
  std::vector<std::vector<int>> constraints;  ///< constraints of every step
};

Steps steps_of(const PoseGraph& graph) {
  Steps steps;
  steps.nodes.resize(graph.nodes.size());
  std::iota(steps.nodes.begin(), steps.nodes.end(), 0);
  std::sort(steps.nodes.begin(), steps.nodes.end(),
            [&](int a, int b) { return graph.nodes[a].id < graph.nodes[b].id; });
  std::vector<int> step_of(graph.nodes.size());
  for (std::size_t i = 0; i < steps.nodes.size(); ++i)
    step_of[steps.nodes[i]] = static_cast<int>(i);
  steps.constraints.resize(graph.nodes.size());
  const auto index = graph.index_by_id();
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const Constraint& constraint = graph.constraints[i];
    NodeId id;
    if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraint))
      id = std::max(relative->from, relative->to);
    else
      id = std::get<PositionConstraint>(constraint).node;
    steps.constraints[step_of[index.at(id)]].push_back(static_cast<int>(i));
  }
  return steps;
}

void summarize(IncrementalReplay& replay) {
  std::vector<double> sorted = replay.step_cpu_ms;
  if (sorted.empty()) return;
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  replay.step_cpu_ms_mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
  replay.step_cpu_ms_p95 = sorted[static_cast<std::size_t>(std::ceil(0.95 * count)) - 1];
  replay.step_cpu_ms_max = sorted.back();
}

}  // namespace

IncrementalReplay optimize_incrementally(
    const PoseGraph& graph, const IncrementalOptions& options,
    const std::function<void(int, const IncrementalOptimizer&)>& watch) {
  graph.check();
  const Steps steps = steps_of(graph);
  IncrementalOptimizer optimizer(options);
  IncrementalReplay replay;
  replay.outcome = Outcome::ok();
  const auto count = [&](const IncrementalStep& step) {
    replay.iterations += step.iterations;
    replay.solved_from_scratch += step.solved_from_scratch;
    replay.outcome = step.outcome;
  };
  for (std::size_t i = 0; i < steps.nodes.size(); ++i) {
    std::vector<Constraint> constraints;
    for (const int c : steps.constraints[i]) constraints.push_back(graph.constraints[c]);
    const double begin_ms = thread_cpu_ms();
    count(optimizer.add({graph.nodes[steps.nodes[i]]}, constraints));
    if (i + 1 == steps.nodes.size()) count(optimizer.finish());
    replay.step_cpu_ms.push_back(thread_cpu_ms() - begin_ms);
    if (watch) watch(static_cast<int>(i) + 1, optimizer);
  }
  replay.graph = graph;
  for (PoseNode& node : replay.graph.nodes)
    if (!node.fixed) node.T_world_node = *optimizer.pose(node.id);
  replay.cost = optimizer.cost();
  summarize(replay);
  return replay;
}

}  // namespace placegraph
