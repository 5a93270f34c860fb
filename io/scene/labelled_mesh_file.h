#pragma once
#include <placegraph/graph/scene/labelled_mesh.h>

#include <string>

namespace placegraph {

/// The mesh as an ascii PLY: `comment class NUMBER NAME` per class, vertices with x y z [m], faces
/// with vertex_indices and label.
std::string to_ply(const LabelledMesh& mesh);

/// Reads the output of `to_ply`. Throws FileError with the line if the file is missing, truncated,
/// in another format, refers to a missing vertex or class, or has a number that is not finite.
LabelledMesh read_labelled_mesh(const std::string& path);

}  // namespace placegraph
