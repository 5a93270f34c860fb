#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/pose_graph_file.h>

namespace placegraph {

enum class PoseGraphFormat { kG2o, kToro, kIsam };

/// Recognizes the format from the tags: VERTEX_*, EDGE_*, FIX, PARAMS_* are g2o's, VERTEX2 and
/// VERTEX3 are TORO's, ODOMETRY and LANDMARK are iSAM's; EDGE2 and EDGE3 are TORO's in a file with
/// its vertices and iSAM's in a file of edges alone, unless the six numbers of an EDGE2 have a zero
/// at a diagonal entry of iSAM's root. Leaves the file at its begin. Throws FileError for any other
/// tag and for a file without tags.
PoseGraphFormat pose_graph_format(TextFile& file);

/// As read_g2o, from an open file.
PoseGraph parse_g2o(TextFile& file, const PoseGraphReading& reading);

/// The same with measured poses (EDGE_PRIOR_SE2, EDGE_SE3_PRIOR) and point landmarks (VERTEX_XY
/// with EDGE_SE2_XY, VERTEX_TRACKXYZ with EDGE_SE3_TRACKXYZ). If PARAMS_SE3OFFSET mounts the sensor
/// away from the node, measurements are converted to the node. A point without its own line is
/// placed by its first observation.
LandmarkGraph parse_g2o_landmarks(TextFile& file, const PoseGraphReading& reading);

/// As read_toro, from an open file.
PoseGraph parse_toro(TextFile& file, const PoseGraphReading& reading);

/// As read_isam, from an open file.
PoseGraph parse_isam(TextFile& file, const PoseGraphReading& reading);

}  // namespace placegraph
