#include <placegraph/eval/plots/pose_graph_plot.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <algorithm>

namespace placegraph {
namespace {

/// The nodes in their order, with a gap where no odometry joins a node to the previous one.
std::vector<std::optional<Eigen::Vector3d>> line_of(const PoseGraph& graph,
                                                    const NodeIndex& index) {
  std::vector<char> joined(graph.nodes.size());
  for (const Constraint& constraint : graph.constraints) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (!edge || edge->source != ConstraintSource::kOdometry) continue;
    const int from = index.at(edge->from), to = index.at(edge->to);
    if (std::abs(from - to) == 1) joined[std::max(from, to)] = true;
  }
  std::vector<std::optional<Eigen::Vector3d>> line;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (i > 0 && !joined[i]) line.emplace_back();
    line.emplace_back(position_of(graph.nodes[i].T_world_node));
  }
  return line;
}

}  // namespace

Plot plot_of(const PoseGraph& before, const PoseGraph& after, const std::vector<int>& rejected) {
  const NodeIndex index = after.index_by_id();
  Plot plot;
  if (after.kind() == PoseKind::kSim3) plot.unit = "units";
  PlotCurve start{"before", line_of(before, index), true}, end{"after", line_of(after, index)};
  plot.curves = {start, end};
  std::vector<char> is_rejected(after.constraints.size());
  for (const int i : rejected) is_rejected[i] = true;
  for (std::size_t i = 0; i < after.constraints.size(); ++i) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&after.constraints[i]);
    if (!edge || (edge->source == ConstraintSource::kOdometry && !is_rejected[i])) continue;
    const std::pair<Eigen::Vector3d, Eigen::Vector3d> link = {
        position_of(after.nodes[index.at(edge->from)].T_world_node),
        position_of(after.nodes[index.at(edge->to)].T_world_node)};
    (is_rejected[i] ? plot.rejected_links_m : plot.links_m).push_back(link);
  }
  return plot;
}

}  // namespace placegraph
