#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace placegraph {

/// Corners of a cube by the bits of their numbers (x, y, z), and its edges.
struct CubeEdge {
  int from = 0, to = 0;  ///< corners; `to` is farther along the axis
  int axis = 0;          ///< 0 x, 1 y, 2 z
};

/// The twelve edges: those along x, then y, then z.
const std::array<CubeEdge, 12>& cube_edges();

/// The triangles of a surface in a cube (Lorensen and Cline 1987, "Marching cubes").
///
/// `inside`: bit i is set if corner i is inside the surface. A triangle has its corners on three
/// edges; they are counter-clockwise as seen from outside. Where a side of the cube has two inner
/// corners on a diagonal, the surface separates them: both cubes of a side agree, and the surface
/// has no holes.
const std::vector<std::array<std::uint8_t, 3>>& cube_triangles(unsigned inside);

}  // namespace placegraph
