#pragma once
#include <placegraph/graph/pose_graph/constraint.h>

namespace placegraph {

/// Position of a node in the world; z is 0 in the plane.
inline Eigen::Vector3d position_of(const Pose& T_world_node) {
  if (const SE2* planar = std::get_if<SE2>(&T_world_node))
    return {planar->translation().x(), planar->translation().y(), 0};
  if (const SE3* T = std::get_if<SE3>(&T_world_node)) return T->translation();
  return std::get<Sim3>(T_world_node).translation();
}

}  // namespace placegraph
