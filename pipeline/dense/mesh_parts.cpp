#include <placegraph/pipeline/dense/mesh_parts.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace placegraph {
namespace {

/// Twice the area of a triangle times its normal.
Eigen::Vector3d double_area(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& face) {
  const auto at = [&](int i) {
    return mesh.positions[static_cast<std::size_t>(face[static_cast<std::size_t>(i)])];
  };
  return (at(1) - at(0)).cross(at(2) - at(0));
}

/// The first vertex of the part of a vertex; halves the way to it for the next search.
std::size_t part_of(std::vector<std::size_t>& parent, std::size_t vertex) {
  while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
  return vertex;
}

}  // namespace

std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.positions.size(), Eigen::Vector3d::Zero());
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d area = double_area(mesh, face);
    for (const std::int32_t corner : face) sums[static_cast<std::size_t>(corner)] += area;
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(sums.size());
  for (const Eigen::Vector3d& sum : sums) {
    const double size = sum.norm();
    normals.push_back(size > 0 ? Eigen::Vector3f((sum / size).cast<float>())
                               : Eigen::Vector3f(0, 0, 1));
  }
  return normals;
}

void remove_small_parts(TriangleMesh& mesh, double least_area) {
  std::vector<std::size_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const auto& face : mesh.faces)
    for (const std::size_t k : {1, 2}) {
      const std::size_t a = part_of(parent, static_cast<std::size_t>(face[0]));
      const std::size_t b = part_of(parent, static_cast<std::size_t>(face[k]));
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<double> areas(mesh.positions.size(), 0);
  for (const auto& face : mesh.faces)
    areas[part_of(parent, static_cast<std::size_t>(face[0]))] +=
        0.5 * double_area(mesh, face).norm();

  TriangleMesh kept;
  std::vector<std::int32_t> numbers(mesh.positions.size(), -1);
  for (const auto& face : mesh.faces) {
    if (areas[part_of(parent, static_cast<std::size_t>(face[0]))] < least_area) continue;
    std::array<std::int32_t, 3> moved{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(face[k]);
      if (numbers[vertex] < 0) {
        numbers[vertex] = static_cast<std::int32_t>(kept.positions.size());
        kept.positions.push_back(mesh.positions[vertex]);
        kept.normals.push_back(mesh.normals[vertex]);
        kept.rgb.push_back(mesh.rgb[vertex]);
      }
      moved[k] = numbers[vertex];
    }
    kept.faces.push_back(moved);
  }
  mesh = std::move(kept);
}

}  // namespace placegraph
