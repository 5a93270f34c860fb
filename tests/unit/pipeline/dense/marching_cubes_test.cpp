#include <gtest/gtest.h>
#include <placegraph/pipeline/dense/marching_cubes.h>

#include <Eigen/Geometry>
#include <map>
#include <set>

namespace placegraph {
namespace marching_cubes_test {

Eigen::Vector3d corner(int i) { return {double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)}; }

Eigen::Vector3d middle(std::uint8_t edge) {
  return 0.5 * (corner(cube_edges()[edge].from) + corner(cube_edges()[edge].to));
}

TEST(MarchingCubes, EdgesJoinNeighbours) {
  std::set<std::pair<int, int>> edges;
  for (const CubeEdge& edge : cube_edges()) {
    EXPECT_EQ(edge.to - edge.from, 1 << edge.axis);
    edges.insert({edge.from, edge.to});
  }
  EXPECT_EQ(edges.size(), 12u);
}

TEST(MarchingCubes, OneCornerIsCutOffAndFacesAway) {
  EXPECT_TRUE(cube_triangles(0).empty());
  EXPECT_TRUE(cube_triangles(255).empty());
  for (int i = 0; i < 8; ++i) {
    const auto& triangles = cube_triangles(1U << i);
    ASSERT_EQ(triangles.size(), 1u);
    const Eigen::Vector3d a = middle(triangles[0][0]), b = middle(triangles[0][1]),
                          c = middle(triangles[0][2]);
    EXPECT_GT((b - a).cross(c - a).dot(a - corner(i)), 0) << i;
  }
}

TEST(MarchingCubes, EveryCutEdgeHasAVertex) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    std::set<int> cut, used;
    for (int e = 0; e < 12; ++e)
      if ((inside >> cube_edges()[static_cast<std::size_t>(e)].from & 1U) !=
          (inside >> cube_edges()[static_cast<std::size_t>(e)].to & 1U))
        cut.insert(e);
    for (const auto& triangle : cube_triangles(inside))
      used.insert(triangle.begin(), triangle.end());
    EXPECT_EQ(used, cut) << inside;
  }
}

TEST(MarchingCubes, NoDiagonalIsOnASide) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    std::map<std::pair<int, int>, int> directed;
    for (const auto& t : cube_triangles(inside))
      for (std::size_t k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, count] : directed) {
      EXPECT_EQ(count, 1) << inside;
      if (!directed.count({edge.second, edge.first})) continue;  // on the border
      const Eigen::Vector3d a = middle(static_cast<std::uint8_t>(edge.first));
      const Eigen::Vector3d b = middle(static_cast<std::uint8_t>(edge.second));
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_FALSE(a[axis] == b[axis] && (a[axis] == 0 || a[axis] == 1)) << inside;
    }
  }
}

/// The directed border of the triangles of a cube on the side where coordinate `axis` is `at`, by
/// the positions of the edges' middles.
std::set<std::pair<std::array<double, 2>, std::array<double, 2>>> border(unsigned inside, int axis,
                                                                         double at) {
  std::map<std::pair<int, int>, int> directed;
  for (const auto& t : cube_triangles(inside))
    for (std::size_t k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
  std::set<std::pair<std::array<double, 2>, std::array<double, 2>>> result;
  for (const auto& [edge, count] : directed) {
    if (directed.count({edge.second, edge.first})) continue;
    const Eigen::Vector3d a = middle(static_cast<std::uint8_t>(edge.first));
    const Eigen::Vector3d b = middle(static_cast<std::uint8_t>(edge.second));
    if (a[axis] != at || b[axis] != at) continue;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    result.insert({{a[u], a[v]}, {b[u], b[v]}});
  }
  return result;
}

TEST(MarchingCubes, NeighboursFitTogether) {
  // For each side with corners in a state, the border there must be the same, the other way round,
  // for all cubes on one hand and all on the other.
  for (int axis = 0; axis < 3; ++axis)
    for (unsigned low = 0; low < 256; ++low)
      for (unsigned high = 0; high < 256; ++high) {
        bool shared = true;
        for (int i = 0; i < 8; ++i)
          if (!(i & (1 << axis))) shared &= (low >> (i | (1 << axis)) & 1U) == (high >> i & 1U);
        if (!shared) continue;
        auto of_low = border(low, axis, 1), of_high = border(high, axis, 0);
        ASSERT_EQ(of_low.size(), of_high.size()) << low << " " << high;
        for (const auto& [a, b] : of_low) ASSERT_TRUE(of_high.count({b, a})) << low << " " << high;
      }
}

}  // namespace marching_cubes_test
}  // namespace placegraph
