#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Position of a pose; z is 0 in the plane.
Eigen::Vector3d position_of(const Pose& T_world_node);
/// A pose without its scale; a pose of SE(2) is at z = 0.
SE3 rigid_part(const Pose& pose);
/// Scale of a pose; 1 unless the pose is Sim3.
double scale_of(const Pose& pose);

/// Converts a graph of similarities to one over SE(3), for programs without scale.
///
/// Nodes keep rotation and position, and every measured translation is multiplied by the scale of
/// its first node. Information on the scale is marginalized out, information on the translation
/// divided by the squared scale; measured positions are unchanged. Other graphs are returned
/// unchanged. The costs of the two graphs at the same node poses differ by the contributions of the
/// scales.
PoseGraph rigid_graph(const PoseGraph& graph);

}  // namespace placegraph
