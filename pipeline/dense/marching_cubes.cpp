#include <placegraph/pipeline/dense/marching_cubes.h>

namespace placegraph {
namespace {

std::array<CubeEdge, 12> make_edges() {
  std::array<CubeEdge, 12> edges{};
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 8; ++corner)
      if (!(corner & (1 << axis))) edges[count++] = {corner, corner | (1 << axis), axis};
  return edges;
}

int edge_between(int a, int b) {
  const auto& edges = cube_edges();
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((edges[i].from == a && edges[i].to == b) || (edges[i].from == b && edges[i].to == a))
      return static_cast<int>(i);
  return -1;
}

/// The corners of a side of the cube, counter-clockwise as seen from outside.
std::array<int, 4> side_corners(int axis, bool far) {
  const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3);
  const int base = far ? 1 << axis : 0;
  if (far) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

using Triangles = std::vector<std::array<std::uint8_t, 3>>;

/// Whether two edges are on one side of the cube.
bool share_side(std::uint8_t a, std::uint8_t b) {
  const CubeEdge &first = cube_edges()[a], &second = cube_edges()[b];
  for (int axis = 0; axis < 3; ++axis)
    if (first.axis != axis && second.axis != axis &&
        (first.from >> axis & 1) == (second.from >> axis & 1))
      return true;
  return false;
}

/// Cuts a polygon into triangles at one of its corners, from which no diagonal is on a side of the
/// cube: the neighbour there could have the same one, and the edge four triangles.
void add_polygon(const std::vector<std::uint8_t>& polygon, Triangles& triangles) {
  const std::size_t n = polygon.size();
  std::size_t from = 0;
  const auto is_free = [&](std::size_t corner) {
    for (std::size_t k = 2; k + 1 < n; ++k)
      if (share_side(polygon[corner], polygon[(corner + k) % n])) return false;
    return true;
  };
  while (from + 1 < n && !is_free(from)) ++from;
  for (std::size_t k = 1; k + 1 < n; ++k)
    triangles.push_back({polygon[from], polygon[(from + k + 1) % n], polygon[(from + k) % n]});
}

/// On each side of the cube the surface enters through an edge and leaves through another, with the
/// inner corners on one hand; followed from side to side these pieces are closed polygons.
Triangles triangles_of(unsigned inside) {
  const auto in = [inside](int corner) { return (inside >> corner & 1U) != 0; };
  std::array<int, 12> next{};
  next.fill(-1);
  for (int side = 0; side < 6; ++side) {
    const std::array<int, 4> corners = side_corners(side / 2, side % 2 != 0);
    for (std::size_t i = 0; i < 4; ++i) {
      // From the edge by which the walk around the side leaves the inner corners, back to that by
      // which it entered them.
      if (!in(corners[i]) || in(corners[(i + 1) % 4])) continue;
      std::size_t first = i;
      while (in(corners[(first + 3) % 4])) first = (first + 3) % 4;
      const int leave = edge_between(corners[i], corners[(i + 1) % 4]);
      const int enter = edge_between(corners[(first + 3) % 4], corners[first]);
      next[static_cast<std::size_t>(leave)] = enter;
    }
  }
  Triangles triangles;
  std::array<bool, 12> done{};
  for (std::size_t start = 0; start < 12; ++start) {
    if (next[start] < 0 || done[start]) continue;
    std::vector<std::uint8_t> polygon;
    for (std::size_t edge = start; !done[edge]; edge = static_cast<std::size_t>(next[edge])) {
      done[edge] = true;
      polygon.push_back(static_cast<std::uint8_t>(edge));
    }
    add_polygon(polygon, triangles);
  }
  return triangles;
}

}  // namespace

const std::array<CubeEdge, 12>& cube_edges() {
  static const std::array<CubeEdge, 12> edges = make_edges();
  return edges;
}

const std::vector<std::array<std::uint8_t, 3>>& cube_triangles(unsigned inside) {
  static const std::vector<Triangles> cases = [] {
    std::vector<Triangles> all;
    for (unsigned bits = 0; bits < 256; ++bits) all.push_back(triangles_of(bits));
    return all;
  }();
  return cases[inside & 255U];
}

}  // namespace placegraph
