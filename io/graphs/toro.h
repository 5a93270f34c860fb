#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a pose graph in the TORO format.
///
/// TORO is by Grisetti et al. (openslam.org/toro.html). Lines may come in any order; comments (#)
/// are skipped:
///
///   VERTEX2 id x y theta
///   EDGE2 from to forward sideward rotate I_ff I_fs I_ss I_rr I_fr I_sr
///   VERTEX3 id x y z roll pitch yaw
///   EDGE3 from to x y z roll pitch yaw I_11 I_12 .. I_16 I_22 .. I_66
///
/// Vertices are T_world_node, edges T_from_to. Lengths [m], angles [rad]; R = R_z(yaw) R_y(pitch)
/// R_x(roll). The information of EDGE2 has its own order, as above (f forward, s sideward, r
/// rotate); that of EDGE3 is upper-triangular over [x y z roll pitch yaw]. Near zero these angles
/// equal the rotation vector. The information is therefore used unchanged for our tangent
/// [translation, rotation] and belongs to RotationError::kLog. Errors as read_g2o.
PoseGraph read_toro(const std::string& path, const PoseGraphReading& reading = {});

}  // namespace placegraph
