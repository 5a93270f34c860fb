#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/ply_header.h>

namespace placegraph {

std::string ply_header(NumberForm form, const std::vector<std::string>& comments,
                       const std::vector<PlyElement>& elements) {
  std::string header = fmt::format("ply\nformat {} 1.0\n",
                                   form == NumberForm::kBinary ? "binary_little_endian" : "ascii");
  for (const std::string& comment : comments) {
    require(comment.find_first_of("\r\n") == std::string::npos,
            "PLY: a comment is one line: " + comment);
    header += "comment " + comment + "\n";
  }
  for (const PlyElement& element : elements) {
    header += fmt::format("element {} {}\n", element.name, element.count);
    for (const PlyProperty& property : element.properties)
      header += fmt::format("property {} {}\n", property.type, property.name);
  }
  return header + "end_header\n";
}

}  // namespace placegraph
