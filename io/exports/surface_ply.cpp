#include <fmt/format.h>
#include <placegraph/io/files/little_endian.h>
#include <placegraph/io/exports/ply_header.h>
#include <placegraph/io/exports/surface_ply.h>

#include <iterator>

namespace placegraph {
namespace {

/// The vertices of a surface; `more`: their properties behind those that all have.
PlyElement surface_vertices(std::size_t count, const std::vector<PlyProperty>& more = {}) {
  PlyElement vertices{"vertex",
                      count,
                      {{"float", "x"},
                       {"float", "y"},
                       {"float", "z"},
                       {"float", "nx"},
                       {"float", "ny"},
                       {"float", "nz"},
                       {"uchar", "red"},
                       {"uchar", "green"},
                       {"uchar", "blue"}}};
  vertices.properties.insert(vertices.properties.end(), more.begin(), more.end());
  return vertices;
}

void append_vertex(std::string& ply, NumberForm form, const Eigen::Vector3d& position,
                   const Eigen::Vector3f& normal, const std::array<std::uint8_t, 3>& rgb) {
  const Eigen::Vector3f p = position.cast<float>();
  if (form == NumberForm::kText) {
    fmt::format_to(std::back_inserter(ply), "{} {} {} {} {} {} {} {} {}", p[0], p[1], p[2],
                   normal[0], normal[1], normal[2], rgb[0], rgb[1], rgb[2]);
    return;
  }
  for (int i = 0; i < 3; ++i) append_number(ply, float{p[i]});
  for (int i = 0; i < 3; ++i) append_number(ply, float{normal[i]});
  for (const std::uint8_t value : rgb) append_number(ply, value);
}

}  // namespace

std::string to_ply(const std::vector<DensePoint>& points, NumberForm form,
                   const std::vector<std::string>& comments) {
  std::string ply =
      ply_header(form, comments, {surface_vertices(points.size(), {{"int", "pixels"}})});
  for (const DensePoint& point : points) {
    append_vertex(ply, form, point.position, point.normal, point.rgb);
    if (form == NumberForm::kBinary)
      append_number(ply, std::int32_t{point.pixels});
    else
      ply += fmt::format(" {}\n", point.pixels);
  }
  return ply;
}

std::string to_ply(const TriangleMesh& mesh, NumberForm form,
                   const std::vector<std::string>& comments) {
  std::string ply =
      ply_header(form, comments,
                 {surface_vertices(mesh.positions.size()),
                  {"face", mesh.faces.size(), {{"list uchar int", "vertex_indices"}}}});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append_vertex(ply, form, mesh.positions[i], mesh.normals[i], mesh.rgb[i]);
    if (form == NumberForm::kText) ply += '\n';
  }
  for (const auto& face : mesh.faces) {
    if (form == NumberForm::kText) {
      ply += fmt::format("3 {} {} {}\n", face[0], face[1], face[2]);
      continue;
    }
    append_number(ply, std::uint8_t{3});
    for (const std::int32_t corner : face) append_number(ply, corner);
  }
  return ply;
}

}  // namespace placegraph
