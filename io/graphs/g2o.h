#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/graphs/pose_graph_reading.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a pose graph in the form of g2o.
///
/// Takes VERTEX_ and EDGE_ lines of SE2, SE3:QUAT and SIM3:EXPMAP, EDGE_PRIOR_SE2_XY (a measured
/// position) and FIX lines, in any order. PARAMS_* lines and comments (#) are skipped; any other
/// tag is an error, and so are priors and point landmarks, which read_landmark_graph takes.
///
/// Vertices are T_world_node, edges T_from_to. Information is upper-triangular in g2o's order:
/// [x y theta], [translation, rotation], and for SIM3 [rotation, translation, log scale], which is
/// also the order of the logarithm that a SIM3 pose is written as (the four numbers of a camera
/// that may follow a vertex are skipped). The information for SE3 belongs to g2o's own error
/// (quaternion vector part, half the angle); it is kept as written, and RotationError chooses the
/// error it is applied to. Edges between consecutive ids (or, where ids have gaps throughout, from
/// one id to the next) count as odometry, the rest as loops.
///
/// Throws FileError with the line: unknown tag, wrong number of fields, not a number, not
/// finite, quaternion not of unit length (1e-2), a vertex that is there twice, an edge or FIX on a
/// vertex that is not there or from a vertex to itself, kinds mixed, information that is indefinite
/// or all zero; also if the file has no vertices.
PoseGraph read_g2o(const std::string& path, const PoseGraphReading& reading = {});

/// Writes a pose graph in the form of g2o with 17 significant digits.
///
/// The file is replaced as a whole or not at all. Robust kernels have no place in it and are left
/// out. Throws ArgumentError for a graph that check() refuses or constraints that g2o has no text
/// form for, FileError if it cannot be written.
void write_g2o(const std::string& path, const PoseGraph& graph);
/// Writes poses, priors and point landmarks in the form of g2o, otherwise as above.
void write_g2o(const std::string& path, const LandmarkGraph& graph);

}  // namespace placegraph
