#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/graphs/pose_graph_reading.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads VERTEX_ and EDGE_ lines of SE2, SE3:QUAT and SIM3:EXPMAP, EDGE_PRIOR_SE2_XY (a measured
/// position) and FIX lines, in any order;
/// PARAMS_* lines and comments (#) are passed over, any other tag is an error; so are priors and
/// point landmarks, which read_landmark_graph takes. Vertices are
/// T_world_node, edges T_from_to; information is upper-triangular in g2o's order: [x y theta],
/// [translation, rotation], and for SIM3 [rotation, translation, log scale], which is also the
/// order of the logarithm a SIM3 pose is written as (the four numbers of a camera that may follow a
/// vertex are passed over). The file's information for SE3 belongs to g2o's own error (quaternion
/// vector part, half the angle); it is kept as written, and which error it is applied to is the
/// optimizer's choice (RotationError). Edges between consecutive ids count as odometry, the rest as
/// loops. Throws FileError with the line: unknown tag, wrong number of fields, not a number, not
/// finite, quaternion not of unit length (1e-2), a vertex that is there twice, an edge or FIX on a
/// vertex that is not there or from a vertex to itself, kinds mixed, information that is indefinite
/// or all zero; also if the file has no vertices.
PoseGraph read_g2o(const std::string& path, const PoseGraphReading& reading = {});

/// Writes with 17 significant digits, atomically. Robust kernels have no place in the file and are
/// left out. Throws ArgumentError for constraints g2o has no text form for.
void write_g2o(const std::string& path, const PoseGraph& graph);
void write_g2o(const std::string& path, const LandmarkGraph& graph);

}  // namespace placegraph
