#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/io/graphs/pose_graph_reading.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a graph in the form of g2o, TORO or iSAM, which its tags tell. Throws FileError as
/// read_g2o.
PoseGraph read_pose_graph(const std::string& path, const PoseGraphReading& reading = {});
/// The same with the priors and point landmarks that a file in g2o's form may hold.
LandmarkGraph read_landmark_graph(const std::string& path, const PoseGraphReading& reading = {});

}  // namespace placegraph
