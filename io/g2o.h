#pragma once
#include <placegraph/graph/pose_graph.h>

#include <string>

namespace placegraph {

/// Reads VERTEX_SE2 / EDGE_SE2, VERTEX_SE3:QUAT / EDGE_SE3:QUAT and FIX lines, in any order;
/// PARAMS_* lines and comments (#) are passed over, any other tag is an error. Vertices are
/// T_world_node, edges T_from_to, information upper-triangular in g2o's order [x y theta] or
/// [translation, rotation]. The file's information for SE3 belongs to g2o's own error (quaternion
/// vector part, half the angle); it is kept as written, and which error it is applied to is the
/// optimizer's choice (RotationError). Edges between consecutive ids count as odometry, the rest as
/// loops. Throws FileError with the line: unknown tag, wrong number of fields, not a number, not
/// finite, quaternion not of unit length (1e-2), a vertex that is there twice, an edge or FIX on a
/// vertex that is not there or from a vertex to itself, SE2 mixed with SE3, information that is
/// indefinite or all zero; also if the file has no vertices.
PoseGraph read_g2o(const std::string& path);

/// Writes with 17 significant digits, atomically. Robust kernels have no place in the file and are
/// left out. Throws ArgumentError for Sim3 nodes or constraints g2o has no text form for.
void write_g2o(const std::string& path, const PoseGraph& graph);

}  // namespace placegraph
