#include <placegraph/backend/initialization/held_nodes.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr double kStiffness = 1e3;  // relative to the weights of the heaviest edge

template <class Group>
void constrain_held_nodes(const PackedGraph<Group>& graph,
                          IsotropicProblem<kSpaceDim<Group>>& problem) {
  double rotation_weight = 0, translation_weight = 0;
  for (const auto& edge : problem.edges) {
    rotation_weight = std::max(rotation_weight, kStiffness * edge.rotation_weight);
    translation_weight = std::max(translation_weight, kStiffness * edge.translation_weight);
  }
  const GraphComponents& components = graph.components;
  std::vector<int> last(components.first.size(), -1);  // last held node of the component
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    if (!components.held[i]) continue;
    int& previous = last[components.component[i]];
    if (previous >= 0) {
      const auto R_world_from = graph.poses[previous].rotation();
      const auto R_from_world = R_world_from.inverse();
      problem.edges.push_back(
          {previous, static_cast<int>(i), (R_from_world * graph.poses[i].rotation()).matrix(),
           R_from_world * (graph.poses[i].translation() - graph.poses[previous].translation()),
           rotation_weight, translation_weight});
    }
    previous = static_cast<int>(i);
  }
}

}  // namespace

template <class Group>
IsotropicProblem<kSpaceDim<Group>> held_node_constraints(const PackedGraph<Group>& graph,
                                                         RotationError rotation_error) {
  Eigen::VectorXd log_scale;
  if constexpr (Group::kDof == 7) {
    log_scale.resize(static_cast<Eigen::Index>(graph.poses.size()));
    for (Eigen::Index i = 0; i < log_scale.size(); ++i)
      log_scale[i] = std::log(graph.poses[static_cast<std::size_t>(i)].scale());
  }
  auto problem = isotropic_problem(graph, rotation_error, log_scale);
  constrain_held_nodes(graph, problem);
  return problem;
}

#define PLACEGRAPH_INSTANTIATE(Group)                                \
  template IsotropicProblem<kSpaceDim<Group>> held_node_constraints( \
      const PackedGraph<Group>&, RotationError);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
