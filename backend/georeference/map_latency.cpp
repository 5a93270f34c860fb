#include <placegraph/backend/georeference/map_latency.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <cmath>
#include <optional>

namespace placegraph {
namespace {

/// The motion within the delay after `stamp_ns` in the map's frame, T_map_later T_map_now^-1.
std::optional<SE3> movement(const Trajectory& motion, std::int64_t stamp_ns, double delay_s,
                            double max_gap_s) {
  const auto delay_ns = static_cast<std::int64_t>(std::llround(1e9 * delay_s));
  const auto now = interpolate(motion, stamp_ns, max_gap_s);
  if (!now) return std::nullopt;
  if (const auto later = interpolate(motion, stamp_ns + delay_ns, max_gap_s))
    return *later * now->inverse();
  if (const auto earlier = interpolate(motion, stamp_ns - delay_ns, max_gap_s))
    return *now * earlier->inverse();
  return std::nullopt;
}

/// A rigid step as a pose of the kind of `like`.
Pose of_kind(const SE3& step, const Pose& like) {
  if (std::holds_alternative<SE3>(like)) return step;
  if (std::holds_alternative<Sim3>(like)) return Sim3(step.rotation(), step.translation(), 1);
  const Eigen::Matrix3d R = step.rotation().matrix();
  return SE2(step.translation().x(), step.translation().y(), std::atan2(R(1, 0), R(0, 0)));
}

template <class Group>
Pose between(const Pose& step_from, const Pose& T_from_to, const Pose& step_to) {
  return std::get<Group>(step_from).inverse() * std::get<Group>(T_from_to) *
         std::get<Group>(step_to);
}

}  // namespace

std::vector<SE3> steps_of_delay(const PoseGraph& map, const std::vector<NodeVisit>& visits,
                                const Trajectory& motion, double delay_s, double max_gap_s) {
  const auto index = map.index_by_id();
  std::vector<std::optional<std::int64_t>> first(map.nodes.size());
  for (const NodeVisit& visit : visits) {
    auto& stamp = first[static_cast<std::size_t>(index.at(visit.node))];
    if (!stamp || visit.stamp_ns < *stamp) stamp = visit.stamp_ns;
  }
  std::vector<SE3> steps(map.nodes.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!first[i]) continue;
    const Pose& node = map.nodes[i].T_world_node;
    const SE3 T_map_node = rigid_part(node);
    const auto moved = movement(motion, *first[i], delay_s, max_gap_s);
    if (!moved) continue;
    const SE3 step = T_map_node.inverse() * *moved * T_map_node;
    steps[i] = SE3(step.rotation(), step.translation() / scale_of(node));
  }
  return steps;
}

void move_nodes(PoseGraph& graph, const std::vector<SE3>& steps) {
  const auto index = graph.index_by_id();
  for (Constraint& constraint : graph.constraints) {
    auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (!edge) continue;
    const Pose& like = edge->T_from_to;
    const Pose from = of_kind(steps[static_cast<std::size_t>(index.at(edge->from))], like);
    const Pose to = of_kind(steps[static_cast<std::size_t>(index.at(edge->to))], like);
    edge->T_from_to = std::visit(
        [&]<class Group>(const Group&) { return between<Group>(from, like, to); }, Pose(like));
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Pose& node = graph.nodes[i].T_world_node;
    const Pose step = of_kind(steps[i], node);
    node = std::visit(
        [&]<class Group>(const Group& T) -> Pose { return T * std::get<Group>(step); }, Pose(node));
  }
}

Trajectory without_delay(const Trajectory& motion, double delay_s, double max_gap_s) {
  Trajectory result = motion;
  for (StampedPose& pose : result.poses) {
    if (!pose.T_world_body) continue;
    if (const auto moved = movement(motion, pose.stamp_ns, delay_s, max_gap_s))
      pose.T_world_body = (*moved * SE3(*pose.T_world_body)).isometry();
  }
  return result;
}

}  // namespace placegraph
