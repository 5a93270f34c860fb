#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <deque>

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

void check_information(const Eigen::Ref<const Eigen::MatrixXd>& information, int size,
                       const std::string& subject) {
  if (information.rows() != size || information.cols() != size)
    refuse(subject, "information is " + std::to_string(information.rows()) + "x" +
                        std::to_string(information.cols()) + ", not " + std::to_string(size) + "x" +
                        std::to_string(size));
  if (!information.allFinite()) refuse(subject, "information is not finite");
  const double largest_entry = information.cwiseAbs().maxCoeff();
  if (largest_entry == 0) refuse(subject, "information is all zero");
  if ((information - information.transpose()).cwiseAbs().maxCoeff() > 1e-9 * largest_entry)
    refuse(subject, "information is not symmetric");
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(information, Eigen::EigenvaluesOnly)
          .eigenvalues();
  if (eigenvalues.minCoeff() < -1e-9 * eigenvalues.cwiseAbs().maxCoeff())
    refuse(subject, "information is indefinite");
}

void check_kernel(const RobustKernel& kernel, const std::string& subject) {
  if (!(kernel.width > 0 && std::isfinite(kernel.width)))
    refuse(subject, "width of the kernel is not positive");
}

/// Every constraint that joins two nodes, by positions.
struct Edge {
  int constraint, to;
  bool odometry;
};

std::vector<std::vector<Edge>> adjacency(const PoseGraph& graph) {
  const auto index = graph.index_by_id();
  std::vector<std::vector<Edge>> edges(graph.nodes.size());
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const auto* relative = std::get_if<RelativePoseConstraint>(&graph.constraints[i]);
    if (!relative) continue;
    const auto from = index.find(relative->from), to = index.find(relative->to);
    if (from == index.end() || to == index.end())
      refuse("constraint " + std::to_string(i), "unknown node");
    const bool odometry = relative->source == ConstraintSource::kOdometry;
    edges[from->second].push_back({static_cast<int>(i), to->second, odometry});
    edges[to->second].push_back({static_cast<int>(i), from->second, odometry});
  }
  return edges;
}

/// Visits every node: along odometry as far as it leads, then across the first other constraint
/// that leads somewhere new. `reached(node, constraint)`, -1 for a root.
template <class Reached>
void traverse(const PoseGraph& graph, Reached&& reached) {
  const auto edges = adjacency(graph);
  std::vector<bool> seen(graph.nodes.size(), false);
  std::deque<int> open;
  std::deque<Edge> postponed;
  const auto visit_node = [&](int node, int constraint) {
    seen[node] = true;
    reached(node, constraint);
    open.push_back(node);
  };
  for (std::size_t root = 0; root < graph.nodes.size(); ++root) {
    if (seen[root]) continue;
    visit_node(static_cast<int>(root), -1);
    while (!open.empty() || !postponed.empty()) {
      if (open.empty()) {
        const Edge edge = postponed.front();
        postponed.pop_front();
        if (!seen[edge.to]) visit_node(edge.to, edge.constraint);
        continue;
      }
      const int node = open.front();
      open.pop_front();
      for (const Edge& edge : edges[node]) {
        if (seen[edge.to]) continue;
        if (edge.odometry)
          visit_node(edge.to, edge.constraint);
        else
          postponed.push_back(edge);
      }
    }
  }
}

}  // namespace

PoseKind PoseGraph::kind() const {
  return nodes.empty() ? PoseKind::kSE3 : kind_of(nodes.front().T_world_node);
}

void PoseGraph::check() const {
  const auto index = index_by_id();
  for (const PoseNode& node : nodes) {
    const std::string subject = "node " + std::to_string(node.id);
    if (&nodes[index.at(node.id)] != &node) refuse(subject, "the id is there twice");
    if (kind_of(node.T_world_node) != kind()) refuse(subject, "of another kind than the first");
    if (!is_finite(node.T_world_node)) refuse(subject, "pose is not finite");
  }
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    std::string subject = "constraint " + std::to_string(i);
    if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraints[i])) {
      subject +=
          " (" + std::to_string(relative->from) + " -> " + std::to_string(relative->to) + ")";
      for (const std::int64_t id : {relative->from, relative->to})
        if (!index.contains(id)) refuse(subject, "unknown node " + std::to_string(id));
      if (relative->from == relative->to) refuse(subject, "joins a node to itself");
      if (kind_of(relative->T_from_to) != kind()) refuse(subject, "of another kind than the nodes");
      if (!is_finite(relative->T_from_to)) refuse(subject, "pose is not finite");
      check_information(relative->information, degrees_of_freedom(kind()), subject);
      check_kernel(relative->kernel, subject);
    } else {
      const auto& position = std::get<PositionConstraint>(constraints[i]);
      if (!index.contains(position.node))
        refuse(subject, "unknown node " + std::to_string(position.node));
      if (!position.position_world.allFinite()) refuse(subject, "position is not finite");
      if (!position.lever_arm.allFinite()) refuse(subject, "lever arm is not finite");
      check_information(position.information, 3, subject);
      check_kernel(position.kernel, subject);
    }
  }
}

std::unordered_map<std::int64_t, int> PoseGraph::index_by_id() const {
  std::unordered_map<std::int64_t, int> index;
  index.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) index.emplace(nodes[i].id, static_cast<int>(i));
  return index;
}

std::vector<int> PoseGraph::components() const {
  std::vector<int> component(nodes.size());
  int count = 0;
  traverse(*this, [&](int node, int constraint) {
    count += constraint < 0;
    component[node] = count - 1;
  });
  return component;
}

std::vector<int> PoseGraph::spanning_tree() const {
  std::vector<int> tree(nodes.size());
  traverse(*this, [&](int node, int constraint) { tree[node] = constraint; });
  return tree;
}

}  // namespace placegraph
