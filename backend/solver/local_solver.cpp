#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/position_error.h>
#include <placegraph/backend/linear/blas_threads.h>
#include <placegraph/backend/solver/ceres_solver.h>
#include <placegraph/backend/solver/local_solver.h>
#include <placegraph/backend/solver/native_solver.h>

namespace placegraph {

template <class Group>
struct LocalSolver<Group>::Impl {
  LocalSolverOptions options;
  NativeSolver<Group> native;
};

template <class Group>
LocalSolver<Group>::LocalSolver(const LocalSolverOptions& options)
    : impl_(new Impl{options, NativeSolver<Group>(options)}) {
  use_one_blas_thread();
}
template <class Group>
LocalSolver<Group>::~LocalSolver() = default;

template <class Group>
LocalSolution LocalSolver<Group>::solve(PackedGraph<Group>& graph) {
  return impl_->options.engine == PoseGraphEngine::kCeres ? solve_with_ceres(graph, impl_->options)
                                                          : impl_->native.solve(graph);
}

template <class Group>
std::vector<double> chi2_by_edge(const PackedGraph<Group>& graph, RotationError rotation_error) {
  std::vector<double> chi2;
  chi2.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    const typename Group::Tangent e = pose_error(
        edge.T_to_from * (graph.poses[edge.from].inverse() * graph.poses[edge.to]), rotation_error);
    chi2.push_back(e.dot(edge.information * e));
  }
  return chi2;
}

template <class Group>
std::vector<double> chi2_by_position(const PackedGraph<Group>& graph) {
  std::vector<double> chi2;
  chi2.reserve(graph.positions.size());
  for (const auto& position : graph.positions) {
    const Eigen::Vector3d e =
        PositionLinearization<Group>(graph.poses[position.node], position.lever_arm,
                                     position.position_world)
            .e;
    chi2.push_back(e.dot(position.information * e));
  }
  return chi2;
}

template <class Group>
double robust_cost(const PackedGraph<Group>& graph, RotationError rotation_error) {
  double cost = 0;
  const std::vector<double> edges = chi2_by_edge(graph, rotation_error);
  for (std::size_t i = 0; i < edges.size(); ++i)
    cost += graph.edges[i].weight * graph.edges[i].kernel.evaluate(edges[i]).rho;
  const std::vector<double> positions = chi2_by_position(graph);
  for (std::size_t i = 0; i < positions.size(); ++i)
    cost += graph.positions[i].weight * graph.positions[i].kernel.evaluate(positions[i]).rho;
  for (const auto& observation : graph.observations) {
    const Eigen::Vector3d e =
        PointLinearization<Group>(graph.poses[observation.node],
                                  point_of(graph.poses[observation.point]), observation.p_node)
            .e;
    cost += e.dot(observation.information * e);
  }
  return cost;
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                  \
  template class LocalSolver<Group>;                                                   \
  template std::vector<double> chi2_by_edge(const PackedGraph<Group>&, RotationError); \
  template std::vector<double> chi2_by_position(const PackedGraph<Group>&);            \
  template double robust_cost(const PackedGraph<Group>&, RotationError);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
