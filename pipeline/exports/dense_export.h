#pragma once
#include <placegraph/io/exports/ply_points.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/exports/export_summary.h>

#include <cstddef>
#include <optional>
#include <string>

namespace placegraph {

/// What is made of the depth of the keyframes.
struct DenseOutputs {
  std::string cloud;            ///< file for the cloud; empty: none
  std::string mesh;             ///< file for the mesh, .ply or .glb; empty: none
  std::optional<double> voxel;  ///< side of the voxels at the map's scale
  NumberForm form{};            ///< form of the numbers of PLY files
};

/// Makes cloud and mesh of a component of a map from the images of its keyframes.
/// Throws FileError if the sequence is no longer there, ArgumentError for voxels that are not
/// positive or too small for the memory, NoResult if the depth is unknown.
DenseSummary write_dense(const DenseOutputs& outputs, const StoredMap& stored, int component,
                         const ExportProgress& progress = {});

}  // namespace placegraph
