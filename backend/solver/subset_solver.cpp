#include <placegraph/backend/solver/subset_solver.h>

#include <utility>

namespace placegraph {

template <class Group>
bool SubsetSolver<Group>::fits(const PackedGraph<Group>& graph) const {
  if (!solver_ || subset_.poses.size() != graph.poses.size()) return false;
  // Share of the edges in use with which a pattern is kept. Chosen.
  constexpr double kLeastShareInUse = 0.9;
  std::vector<char> in_pattern(graph.edges.size(), false);
  std::size_t in_use = 0;
  for (const int edge : edges_) {
    in_pattern[edge] = true;
    if (graph.edges[edge].weight > 0) ++in_use;
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (graph.edges[i].weight > 0 && !in_pattern[i]) return false;
  return static_cast<double>(in_use) >= kLeastShareInUse * static_cast<double>(edges_.size());
}

template <class Group>
void SubsetSolver<Group>::take_pattern(const PackedGraph<Group>& graph) {
  solver_ = std::make_unique<LocalSolver<Group>>(options_);
  subset_.components = graph.components;
  subset_.positions = graph.positions;
  subset_.edges.clear();
  edges_.clear();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (graph.edges[i].weight <= 0) continue;
    edges_.push_back(static_cast<int>(i));
    subset_.edges.push_back(graph.edges[i]);
  }
}

template <class Group>
LocalSolution SubsetSolver<Group>::solve(PackedGraph<Group>& graph) {
  if (!fits(graph)) take_pattern(graph);
  for (std::size_t i = 0; i < edges_.size(); ++i)
    subset_.edges[i].weight = graph.edges[edges_[i]].weight;
  subset_.poses = std::move(graph.poses);
  const LocalSolution solution = solver_->solve(subset_);
  graph.poses = std::move(subset_.poses);
  subset_.poses.resize(graph.poses.size());
  return solution;
}

template class SubsetSolver<SE2>;
template class SubsetSolver<SE3>;
template class SubsetSolver<Sim3>;

}  // namespace placegraph
