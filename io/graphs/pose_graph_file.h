#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/graphs/pose_graph_reading.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a pose graph in the g2o, TORO or iSAM format, recognized by the tags of its lines.
///
/// Throws FileError as read_g2o, also for a file in another format.
PoseGraph read_pose_graph(const std::string& path, const PoseGraphReading& reading = {});
/// Reads a graph as read_pose_graph, with the priors and point landmarks of a g2o file.
LandmarkGraph read_landmark_graph(const std::string& path, const PoseGraphReading& reading = {});

}  // namespace placegraph
