#pragma once
#include <placegraph/graph/internal/scene/labelled_mesh.h>

#include <string>

namespace placegraph {

/// The mesh as an ascii PLY: `comment class NUMBER NAME` a class, vertices with x y z [m], faces
/// with vertex_indices and label.
std::string to_ply(const LabelledMesh& mesh);

/// Reads what `to_ply` writes. Throws FileError with the line if the file is missing, truncated, of
/// another form, names a vertex or class that it does not have, or holds a number that is not
/// finite.
LabelledMesh read_labelled_mesh(const std::string& path);

}  // namespace placegraph
