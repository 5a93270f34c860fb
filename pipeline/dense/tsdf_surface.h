#pragma once
#include <placegraph/io/exports/surface_ply.h>
#include <placegraph/pipeline/dense/tsdf_volume.h>

namespace placegraph {

/// The surface at distance 0 between voxels that were all seen, as far as their distances agree,
/// by marching cubes. Cubes share vertices; normals are the means of the triangles around them.
TriangleMesh surface_of(const TsdfVolume& volume);

}  // namespace placegraph
