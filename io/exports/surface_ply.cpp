#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/little_endian.h>
#include <placegraph/io/exports/surface_ply.h>

#include <iterator>

namespace placegraph {
namespace {

/// The header up to the properties that points and vertices share.
std::string surface_header(std::size_t vertices, NumberForm form,
                           const std::vector<std::string>& comments) {
  std::string header = fmt::format("ply\nformat {} 1.0\n",
                                   form == NumberForm::kBinary ? "binary_little_endian" : "ascii");
  for (const std::string& comment : comments) {
    require(comment.find_first_of("\r\n") == std::string::npos,
            "PLY: a comment is one line: " + comment);
    header += "comment " + comment + "\n";
  }
  header += fmt::format("element vertex {}\n", vertices);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    header += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"})
    header += fmt::format("property uchar {}\n", name);
  return header;
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
      surface_header(points.size(), form, comments) + "property int pixels\nend_header\n";
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
  std::string ply = surface_header(mesh.positions.size(), form, comments) +
                    fmt::format("element face {}\n", mesh.faces.size()) +
                    "property list uchar int vertex_indices\nend_header\n";
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
