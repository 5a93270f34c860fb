#include <placegraph/graph/core/disjoint_sets.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <cmath>
#include <numeric>
#include <optional>

namespace placegraph {
namespace {

bool is_finite(const SE2& T) { return T.matrix().allFinite(); }
bool is_finite(const SE3& T) {
  return T.translation().allFinite() && T.rotation().quaternion().coeffs().allFinite();
}
bool is_finite(const Sim3& S) {
  return std::isfinite(S.scale()) && is_finite(SE3(S.rotation(), S.translation()));
}
bool is_finite(const Pose& pose) {
  return std::visit([](const auto& T) { return is_finite(T); }, pose);
}

[[noreturn]] void refuse(const std::string& subject, const std::string& reason) {
  throw ArgumentError("pose graph: " + subject + ": " + reason);
}

bool has_width(const RobustKernel& kernel) {
  return kernel.width > 0 && std::isfinite(kernel.width);
}

void check_relative(const RelativePoseConstraint& constraint, PoseKind kind, const NodeIndex& index,
                    std::size_t number) {
  const auto fail = [&](const std::string& reason) {
    refuse("constraint " + std::to_string(number) + " (" + to_string(constraint.from) + " -> " +
               to_string(constraint.to) + ")",
           reason);
  };
  for (const NodeId id : {constraint.from, constraint.to})
    if (!index.contains(id)) fail("unknown node " + to_string(id));
  if (constraint.from == constraint.to) fail("joins a node to itself");
  if (kind_of(constraint.T_from_to) != kind) fail("of another kind than the nodes");
  if (!is_finite(constraint.T_from_to)) fail("pose is not finite");
  const Information& information = constraint.information;
  const int size = degrees_of_freedom(kind);
  if (information.rows() != size || information.cols() != size)
    fail("information is " + std::to_string(information.rows()) + "x" +
         std::to_string(information.cols()) + ", not " + std::to_string(size) + "x" +
         std::to_string(size));
  if (const char* fault = fault_of(information)) fail(fault);
  if (!has_width(constraint.kernel)) fail("width of the kernel is not positive");
}

void check_position(const PositionConstraint& constraint, const NodeIndex& index,
                    std::size_t number) {
  const auto fail = [&](const std::string& reason) {
    refuse("constraint " + std::to_string(number), reason);
  };
  if (!index.contains(constraint.node)) fail("unknown node " + to_string(constraint.node));
  if (!constraint.position_world.allFinite()) fail("position is not finite");
  if (!constraint.lever_arm.allFinite()) fail("lever arm is not finite");
  if (const char* fault = fault_of(constraint.information)) fail(fault);
  if (!has_width(constraint.kernel)) fail("width of the kernel is not positive");
}

/// A constraint that joins two nodes, by positions.
struct Edge {
  int constraint, to;
  bool odometry;
};

/// The edges at every node, in the order of the constraints: those of node i are
/// `edges[first[i]]` to `edges[first[i + 1] - 1]`.
struct Adjacency {
  std::vector<int> first;
  std::vector<Edge> edges;

  explicit Adjacency(const PoseGraph& graph) : first(graph.nodes.size() + 2, 0) {
    const std::vector<std::optional<Ends>> ends = ends_of(graph);
    for (const std::optional<Ends>& joined : ends) {
      if (!joined) continue;
      ++first[joined->from + 2];
      ++first[joined->to + 2];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    edges.resize(first.back());
    // Filling moves first[i + 1] from the begin of node i to its end, which is where i + 1 begins.
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (!ends[i]) continue;
      const auto [from, to] = *ends[i];
      const bool odometry = std::get<RelativePoseConstraint>(graph.constraints[i]).source ==
                            ConstraintSource::kOdometry;
      edges[first[from + 1]++] = {static_cast<int>(i), to, odometry};
      edges[first[to + 1]++] = {static_cast<int>(i), from, odometry};
    }
  }

  /// The positions that a constraint joins.
  struct Ends {
    int from, to;
  };
  /// The edge of every constraint; nothing for constraints that join no nodes.
  static std::vector<std::optional<Ends>> ends_of(const PoseGraph& graph) {
    const NodeIndex index = graph.index_by_id();
    std::vector<std::optional<Ends>> ends(graph.constraints.size());
    for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
      const auto* relative = std::get_if<RelativePoseConstraint>(&graph.constraints[i]);
      if (!relative) continue;
      const auto from = index.find(relative->from), to = index.find(relative->to);
      if (!from || !to) refuse("constraint " + std::to_string(i), "unknown node");
      ends[i] = {*from, *to};
    }
    return ends;
  }
};

/// The pose of the other end of an edge, one end of which is at T_world_known.
Pose across(const RelativePoseConstraint& edge, const Pose& T_world_known, bool forward) {
  return std::visit(
      [&](const auto& T_from_to) -> Pose {
        const auto& T_world = std::get<std::decay_t<decltype(T_from_to)>>(T_world_known);
        if (forward) return T_world * T_from_to;
        return T_world * T_from_to.inverse();
      },
      edge.T_from_to);
}

}  // namespace

PoseKind PoseGraph::kind() const {
  return nodes.empty() ? PoseKind::kSE3 : kind_of(nodes.front().T_world_node);
}

void PoseGraph::check() const {
  const NodeIndex index = index_by_id();
  const PoseKind kind = this->kind();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const PoseNode& node = nodes[i];
    const auto fail = [&](const char* reason) { refuse("node " + to_string(node.id), reason); };
    if (index.find(node.id) != static_cast<int>(i)) fail("the id is there twice");
    if (kind_of(node.T_world_node) != kind) fail("of another kind than the first");
    if (!is_finite(node.T_world_node)) fail("pose is not finite");
  }
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraints[i]))
      check_relative(*relative, kind, index, i);
    else
      check_position(std::get<PositionConstraint>(constraints[i]), index, i);
  }
}

NodeIndex PoseGraph::index_by_id() const {
  std::vector<NodeId> ids;
  ids.reserve(nodes.size());
  for (const PoseNode& node : nodes) ids.push_back(node.id);
  return NodeIndex(ids);
}

std::vector<int> PoseGraph::components() const {
  DisjointSets sets(nodes.size());
  for (const auto& joined : Adjacency::ends_of(*this))
    if (joined) sets.join(joined->from, joined->to);
  return sets.numbers();
}

std::vector<int> PoseGraph::spanning_tree() const {
  const Adjacency adjacency(*this);
  std::vector<int> tree(nodes.size(), -1);
  std::vector<char> seen(nodes.size(), false);
  std::vector<int> open;        // reached nodes, in this order
  std::vector<Edge> postponed;  // edges of other sources, tried where odometry ends
  open.reserve(nodes.size());
  std::size_t next_open = 0, next_postponed = 0;
  const auto reach = [&](int node, int constraint) {
    seen[node] = true;
    tree[node] = constraint;
    open.push_back(node);
  };
  for (std::size_t root = 0; root < nodes.size(); ++root) {
    if (seen[root]) continue;
    reach(static_cast<int>(root), -1);
    while (next_open < open.size() || next_postponed < postponed.size()) {
      if (next_open == open.size()) {
        const Edge& edge = postponed[next_postponed++];
        if (!seen[edge.to]) reach(edge.to, edge.constraint);
        continue;
      }
      const auto node = static_cast<std::size_t>(open[next_open++]);
      for (int i = adjacency.first[node]; i < adjacency.first[node + 1]; ++i) {
        const Edge& edge = adjacency.edges[i];
        if (seen[edge.to]) continue;
        if (edge.odometry)
          reach(edge.to, edge.constraint);
        else
          postponed.push_back(edge);
      }
    }
  }
  return tree;
}

void integrate_odometry(PoseGraph& graph) {
  const NodeIndex index = graph.index_by_id();
  const std::vector<int> tree = graph.spanning_tree();
  const auto edge_to = [&](int node) -> const RelativePoseConstraint& {
    return std::get<RelativePoseConstraint>(graph.constraints[tree[node]]);
  };
  std::vector<char> placed(graph.nodes.size());
  std::vector<int> path;  // from a node up to the first whose pose is set
  for (int i = 0; i < static_cast<int>(graph.nodes.size()); ++i) {
    for (int node = i; !placed[node];) {
      placed[node] = true;
      if (tree[node] < 0) break;
      path.push_back(node);
      const RelativePoseConstraint& edge = edge_to(node);
      const bool forward = edge.to == graph.nodes[node].id;
      node = index.at(forward ? edge.from : edge.to);
    }
    for (; !path.empty(); path.pop_back()) {
      PoseNode& node = graph.nodes[path.back()];
      if (node.fixed) continue;
      const RelativePoseConstraint& edge = edge_to(path.back());
      const bool forward = edge.to == node.id;
      const PoseNode& known = graph.nodes[index.at(forward ? edge.from : edge.to)];
      node.T_world_node = across(edge, known.T_world_node, forward);
    }
  }
}

}  // namespace placegraph
