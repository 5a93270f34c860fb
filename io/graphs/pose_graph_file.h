#pragma once
#include <placegraph/io/graphs/pose_graph_builder.h>

#include <string>

namespace placegraph {

enum class PoseGraphFormat { kG2o, kToro, kIsam };

/// What the tags say: VERTEX_*, EDGE_*, FIX, PARAMS_* are g2o's, VERTEX2 and VERTEX3 are TORO's,
/// ODOMETRY and LANDMARK are iSAM's; EDGE2 and EDGE3 are TORO's in a file with its vertices and
/// iSAM's in a file of edges alone, unless the six numbers of an EDGE2 have a zero where iSAM's
/// root has its diagonal. Leaves the file at its begin. Throws FileError for a tag of none of them
/// and for a file without any.
PoseGraphFormat pose_graph_format(TextFile& file);

/// Reads a graph in any of these forms. Throws FileError as read_g2o.
PoseGraph read_pose_graph(const std::string& path, const PoseGraphReading& reading = {});
/// The same with the priors and point landmarks that a file in g2o's form may hold.
LandmarkGraph read_landmark_graph(const std::string& path, const PoseGraphReading& reading = {});

}  // namespace placegraph
