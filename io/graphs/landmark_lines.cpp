#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/io/graphs/landmark_lines.h>

#include <algorithm>
#include <unordered_map>

namespace placegraph {
namespace {

/// Converts a prior of a sensor into one of its node. With E = Z^-1 T O, Log(E) = Ad(O^-1) Log((Z
/// O^-1)^-1 T).
PosePriorConstraint of_node(PosePriorConstraint prior, const SE3& T_node_sensor) {
  if (const SE3* T_world_sensor = std::get_if<SE3>(&prior.T_world_node)) {
    const Matrix6d J = T_node_sensor.inverse().adjoint();
    prior.T_world_node = *T_world_sensor * T_node_sensor.inverse();
    const Matrix6d information = J.transpose() * prior.information * J;
    prior.information = 0.5 * (information + information.transpose());
    prior.beside_node = !T_node_sensor.translation().isZero(0);
  }
  return prior;
}

PointObservation of_node(PointObservation observation, const SE3& T_node_sensor) {
  const Eigen::Matrix3d R = T_node_sensor.rotation().matrix();
  observation.position_node = T_node_sensor * observation.position_node;
  const Eigen::Matrix3d information = R * observation.information * R.transpose();
  observation.information = 0.5 * (information + information.transpose());
  return observation;
}

Eigen::Vector3d seen_from(const Pose& T_world_node, const Eigen::Vector3d& position_node) {
  if (const SE2* planar = std::get_if<SE2>(&T_world_node)) {
    const Eigen::Vector2d at = *planar * Eigen::Vector2d(position_node.head<2>());
    return {at.x(), at.y(), 0};
  }
  return std::get<SE3>(T_world_node) * position_node;
}

bool is_identity(const SE3& T) { return T.log().norm() == 0; }

}  // namespace

int LandmarkLines::first_line() const {
  std::vector<int> lines;
  if (!priors_.empty()) lines.push_back(priors_.front().line);
  if (!points_.empty()) lines.push_back(points_.front().line);
  if (!observations_.empty()) lines.push_back(observations_.front().line);
  return *std::ranges::min_element(lines);
}

void LandmarkLines::add_offset(std::string_view number, const SE3& T_node_sensor) {
  if (!offsets_.emplace(number, T_node_sensor).second)
    file_->fail(fmt::format("parameters {} are defined twice", number));
}

void LandmarkLines::add_prior(std::string_view node, const Pose& T_world_sensor,
                              const Information& information, std::string_view offset) {
  priors_.push_back({{NodeId(file_->integer(node, "id")), T_world_sensor, information},
                     file_->line(),
                     std::string(offset)});
}

void LandmarkLines::add_point(std::string_view id, const Eigen::Vector3d& position_world,
                              bool planar) {
  points_.push_back(
      {{NodeId(file_->integer(id, "id")), position_world, false}, file_->line(), planar});
}

void LandmarkLines::add_observation(std::string_view node, std::string_view point,
                                    const Eigen::Vector3d& position,
                                    const Eigen::Matrix3d& information, bool planar,
                                    std::string_view offset) {
  observations_.push_back({{NodeId(file_->integer(node, "id")), NodeId(file_->integer(point, "id")),
                            position, information},
                           file_->line(),
                           planar,
                           std::string(offset)});
}

bool LandmarkLines::fix(NodeId id) {
  const auto found =
      std::ranges::find_if(points_, [id](const Point& point) { return point.point.id == id; });
  if (found == points_.end()) return false;
  found->point.fixed = true;
  return true;
}

/// Files without parameters use number 0 for no offset.
SE3 LandmarkLines::T_node_sensor(const std::string& offset, int line) const {
  if (offset.empty() || offsets_.empty()) return {};
  const auto found = offsets_.find(offset);
  if (found == offsets_.end())
    throw FileError(file_->path(), line, "there is no line PARAMS_SE3OFFSET " + offset);
  return found->second;
}

void LandmarkLines::add_to(LandmarkGraph& graph) const {
  if (!empty() && graph.poses.kind() == PoseKind::kSim3)
    throw FileError(file_->path(), first_line(),
                    "a graph of similarities has no priors and no point landmarks");
  const auto fail = [this](int line, const std::string& reason) {
    throw FileError(file_->path(), line, reason);
  };
  const NodeIndex nodes = graph.poses.index_by_id();
  const auto node_at = [&](NodeId id, int line) {
    const std::optional<int> node = nodes.find(id);
    if (!node) fail(line, fmt::format("there is no vertex {}", id));
    return *node;
  };
  const auto require_planar = [&](bool planar, int line) {
    if (planar != (graph.poses.kind() == PoseKind::kSE2))
      fail(line, planar ? "is planar, but the poses are not"
                        : "is spatial, but the poses are not in SE3");
  };
  for (const Prior& prior : priors_) {
    require_planar(kind_of(prior.prior.T_world_node) == PoseKind::kSE2, prior.line);
    node_at(prior.prior.node, prior.line);
    const SE3 T = T_node_sensor(prior.offset, prior.line);
    graph.priors.push_back(is_identity(T) ? prior.prior : of_node(prior.prior, T));
  }
  std::unordered_map<NodeId, std::size_t> point_of;
  for (const Point& point : points_) {
    require_planar(point.planar, point.line);
    if (nodes.contains(point.point.id) ||
        !point_of.emplace(point.point.id, graph.points.size()).second)
      fail(point.line, fmt::format("vertex {} is there twice", point.point.id));
    graph.points.push_back(point.point);
  }
  for (const Observation& observation : observations_) {
    require_planar(observation.planar, observation.line);
    const int node = node_at(observation.observation.node, observation.line);
    const SE3 T = T_node_sensor(observation.offset, observation.line);
    const PointObservation seen =
        is_identity(T) ? observation.observation : of_node(observation.observation, T);
    if (nodes.contains(seen.point))
      fail(observation.line, fmt::format("vertex {} is a pose, not a point", seen.point));
    if (point_of.emplace(seen.point, graph.points.size()).second)
      graph.points.push_back(
          {seen.point,
           seen_from(graph.poses.nodes[static_cast<std::size_t>(node)].T_world_node,
                     seen.position_node),
           false});
    graph.observations.push_back(seen);
  }
}

}  // namespace placegraph
