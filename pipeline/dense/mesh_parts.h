#pragma once
#include <placegraph/io/exports/surface_ply.h>

#include <vector>

namespace placegraph {

/// Unit normals of the vertices: the mean of their triangles, weighted by area.
std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh);

/// Removes connected parts with an area of less than `least_area`, and vertices without a triangle.
void remove_small_parts(TriangleMesh& mesh, double least_area);

}  // namespace placegraph
