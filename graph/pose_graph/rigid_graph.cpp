#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

namespace placegraph {
namespace {

/// Information over [translation, rotation]: the log scale is marginalized out, translations are
/// multiplied by `scale`.
Information rigid_information(const Information& of_similarity, double scale) {
  Information information = of_similarity.topLeftCorner(6, 6);
  if (of_similarity(6, 6) > 0) {
    const Vector6d coupling = of_similarity.topRightCorner(6, 1);
    information -= coupling * coupling.transpose() / of_similarity(6, 6);
  }
  information.topRows(3) /= scale;
  information.leftCols(3) /= scale;
  return 0.5 * (information + information.transpose());
}

}  // namespace

Eigen::Vector3d position_of(const Pose& T_world_node) {
  if (const SE2* planar = std::get_if<SE2>(&T_world_node))
    return {planar->translation().x(), planar->translation().y(), 0};
  if (const SE3* T = std::get_if<SE3>(&T_world_node)) return T->translation();
  return std::get<Sim3>(T_world_node).translation();
}

SE3 rigid_part(const Pose& pose) {
  if (const SE2* T = std::get_if<SE2>(&pose))
    return SE3(SO3::exp({0, 0, T->rotation().angle()}),
               {T->translation().x(), T->translation().y(), 0});
  if (const SE3* T = std::get_if<SE3>(&pose)) return *T;
  return rigid_part(std::get<Sim3>(pose));
}

double scale_of(const Pose& pose) {
  const Sim3* S = std::get_if<Sim3>(&pose);
  return S ? S->scale() : 1.0;
}

PoseGraph rigid_graph(const PoseGraph& graph) {
  if (graph.kind() != PoseKind::kSim3) return graph;
  const NodeIndex index = graph.index_by_id();
  PoseGraph rigid = graph;
  for (PoseNode& node : rigid.nodes) {
    const Sim3& S = std::get<Sim3>(node.T_world_node);
    node.T_world_node = SE3(S.rotation(), S.translation());
  }
  for (Constraint& constraint : rigid.constraints) {
    auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (!edge) continue;
    const auto from = static_cast<std::size_t>(index.at(edge->from));
    const double scale = std::get<Sim3>(graph.nodes[from].T_world_node).scale();
    const Sim3& S_from_to = std::get<Sim3>(edge->T_from_to);
    edge->T_from_to = SE3(S_from_to.rotation(), scale * S_from_to.translation());
    edge->information = rigid_information(edge->information, scale);
  }
  return rigid;
}

}  // namespace placegraph
