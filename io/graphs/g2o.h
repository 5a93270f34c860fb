#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a pose graph in the g2o format.
///
/// Accepts VERTEX_ and EDGE_ lines of SE2, SE3:QUAT and SIM3:EXPMAP, EDGE_PRIOR_SE2_XY (a measured
/// position) and FIX lines, in any order. PARAMS_* lines and comments (#) are skipped. Any other
/// tag is an error; so are priors and point landmarks, which read_landmark_graph accepts.
///
/// Vertices are T_world_node, edges T_from_to. Information is upper-triangular in g2o's order: [x y
/// theta], [translation, rotation], and for SIM3 [rotation, translation, log scale]. The last is
/// also the order of the logarithm that represents a SIM3 pose; four camera parameters that may
/// follow a vertex are skipped. The information for SE3 refers to g2o's own error (vector part of
/// the quaternion, half the angle); it is kept as written, and RotationError selects the error that
/// it is applied to. Edges between consecutive ids (or, where ids have gaps throughout, from one id
/// to the next) count as odometry, the others as loops.
///
/// Throws FileError with the line: unknown tag, wrong number of fields, not a number, not finite, a
/// quaternion that is not of unit length (1e-2), a duplicate vertex, an edge or FIX that names a
/// missing vertex, an edge from a vertex to itself, mixed kinds of poses, information that is
/// indefinite or all zero; also if the file has no vertices.
PoseGraph read_g2o(const std::string& path, const PoseGraphReading& reading = {});

/// Writes a pose graph in the g2o format with 17 significant digits.
///
/// FIX lines come last, because readers of other programs end at them (gtsam 4.3). The file is
/// replaced as a whole or not at all. Robust kernels are left out, because the format
/// has none. Throws ArgumentError for a graph that check() rejects or constraints that the format
/// cannot represent, FileError if the file cannot be written.
void write_g2o(const std::string& path, const PoseGraph& graph);
/// Writes poses, priors and point landmarks in the g2o format, otherwise as above.
void write_g2o(const std::string& path, const LandmarkGraph& graph);

}  // namespace placegraph
