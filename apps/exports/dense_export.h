#pragma once
#include <placegraph/io/exports/ply_points.h>
#include <placegraph/io/map/stored_map.h>

#include <cstddef>
#include <optional>
#include <string>

namespace placegraph::apps {

/// What is made of the depth of the keyframes.
struct DenseOutputs {
  std::string cloud;            ///< file for the cloud; empty: none
  std::string mesh;             ///< file for the mesh, .ply or .glb; empty: none
  std::optional<double> voxel;  ///< side of the voxels at the map's scale
  NumberForm form{};            ///< form of the numbers of PLY files
};

/// What was written.
struct DenseSummary {
  std::string source;                              ///< where the depth is from
  std::size_t keyframes = 0;                       ///< number of keyframes with depth
  double voxel = 0;                                ///< side of the voxels
  bool metric = false;                             ///< whether it is in metres
  std::optional<std::size_t> points;               ///< number of points of the cloud
  std::optional<std::size_t> vertices, triangles;  ///< numbers of those of the mesh
  double cpu_s = 0;                                ///< time of the processor
};

/// Makes cloud and mesh of a component of a map from the images of its keyframes.
/// Throws FileError if the sequence is no longer there, ArgumentError for voxels that are not
/// positive or too small for the memory, NoResult if the depth is unknown.
DenseSummary write_dense(const DenseOutputs& outputs, const StoredMap& stored, int component);

/// One line.
std::string to_text(const DenseSummary& summary);

}  // namespace placegraph::apps
