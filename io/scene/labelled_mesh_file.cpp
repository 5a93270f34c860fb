#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/scene/labelled_mesh_file.h>

#include <iterator>

namespace placegraph {
namespace {

struct MeshHeader {
  std::int64_t vertices = -1, faces = -1;
};

/// Reads the header up to end_header; nothing in it sizes an allocation.
MeshHeader read_header(TextFile& file, LabelledMesh& mesh) {
  MeshHeader header;
  std::string_view line;
  std::vector<std::string_view> fields;
  if (!file.next(line) || line != "ply") file.fail("a PLY file begins with \"ply\"");
  while (file.next(line)) {
    split_blank(line, fields);
    if (fields.empty()) continue;
    if (fields[0] == "end_header") {
      if (header.vertices < 0 || header.faces < 0 || mesh.classes.empty())
        file.fail("not a scene with classes, vertices and faces");
      return header;
    }
    if (fields[0] == "format" && (fields.size() != 3 || fields[1] != "ascii"))
      file.fail("not ascii");
    if (fields[0] == "comment" && fields.size() == 4 && fields[1] == "class") {
      if (file.integer(fields[2], "class") != static_cast<std::int64_t>(mesh.classes.size()))
        file.fail("classes are not numbered from 0 on");
      mesh.classes.emplace_back(fields[3]);
    }
    if (fields[0] != "element" || fields.size() != 3) continue;
    const std::int64_t count = file.integer(fields[2], "count");
    if (count < 0) file.fail("count: negative");
    if (fields[1] == "vertex") header.vertices = count;
    if (fields[1] == "face") header.faces = count;
  }
  file.fail("no end_header in a PLY header");
}

}  // namespace

std::string to_ply(const LabelledMesh& mesh) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "ply\nformat ascii 1.0\n");
  for (std::size_t i = 0; i < mesh.classes.size(); ++i)
    fmt::format_to(out, "comment class {} {}\n", i, mesh.classes[i]);
  fmt::format_to(out,
                 "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face {}\nproperty list uchar int vertex_indices\nproperty uchar label\n"
                 "end_header\n",
                 mesh.vertices.size(), mesh.faces.size());
  for (const Eigen::Vector3d& p : mesh.vertices)
    fmt::format_to(out, "{:.3f} {:.3f} {:.3f}\n", p[0], p[1], p[2]);
  for (const LabelledMesh::Face& face : mesh.faces)
    fmt::format_to(out, "{} {} {}\n", face.corners.size(), fmt::join(face.corners, " "),
                   face.label);
  return fmt::to_string(text);
}

LabelledMesh read_labelled_mesh(const std::string& path) {
  TextFile file(path);
  LabelledMesh mesh;
  const MeshHeader header = read_header(file, mesh);
  std::string_view line;
  std::vector<std::string_view> fields;
  const auto next = [&](const char* what, std::size_t columns) {
    if (!file.next(line)) throw FileError(path, std::string("ends before its last ") + what);
    split_blank(line, fields);
    if (fields.size() < columns) file.fail(std::string("no ") + what);
  };
  for (std::int64_t i = 0; i < header.vertices; ++i) {
    next("vertex", 3);
    mesh.vertices.emplace_back(file.number(fields[0], "x"), file.number(fields[1], "y"),
                               file.number(fields[2], "z"));
  }
  for (std::int64_t i = 0; i < header.faces; ++i) {
    next("face", 5);
    LabelledMesh::Face face;
    const std::int64_t corners = file.integer(fields[0], "corners");
    if (corners < 3 || fields.size() != static_cast<std::size_t>(corners) + 2)
      file.fail("corners: " + in_quotes(fields[0]) + " do not fit the line");
    for (std::size_t k = 1; k + 1 < fields.size(); ++k) {
      const std::int64_t vertex = file.integer(fields[k], "corner");
      if (vertex < 0 || vertex >= header.vertices)
        file.fail("corner: " + in_quotes(fields[k]) + " is not a vertex");
      face.corners.push_back(static_cast<int>(vertex));
    }
    const std::int64_t label = file.integer(fields.back(), "label");
    if (label < 0 || label >= static_cast<std::int64_t>(mesh.classes.size()))
      file.fail("label: " + in_quotes(fields.back()) + " is not a class");
    face.label = static_cast<int>(label);
    mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

}  // namespace placegraph
