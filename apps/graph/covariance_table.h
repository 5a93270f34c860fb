#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <string>

namespace placegraph::apps {

/// Writes the covariance of every pose of an optimized graph as a table (.csv): `optimize`.
/// A row has the id of the node and the upper triangle of the matrix in its right tangent. The file
/// is replaced as a whole or not at all. Throws NoResult, which names `in`, if the constraints
/// leave directions undetermined, and FileError.
void write_covariances(const std::string& path, const std::string& in, const PoseGraph& graph,
                       RotationError rotation_error);
/// The same with a row for every point, in the axes of the world; its cells of angles are empty.
void write_covariances(const std::string& path, const std::string& in, const LandmarkGraph& graph,
                       RotationError rotation_error);

}  // namespace placegraph::apps
