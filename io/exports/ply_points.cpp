#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/little_endian.h>
#include <placegraph/io/exports/ply_points.h>

#include <iterator>

namespace placegraph {
namespace {

std::string ply_points_header(std::size_t points, NumberForm form,
                              const std::vector<std::string>& comments) {
  std::string header = fmt::format("ply\nformat {} 1.0\n",
                                   form == NumberForm::kBinary ? "binary_little_endian" : "ascii");
  for (const std::string& comment : comments) {
    require(comment.find_first_of("\r\n") == std::string::npos,
            "PLY: a comment is one line: " + comment);
    header += "comment " + comment + "\n";
  }
  header += fmt::format("element vertex {}\n", points);
  for (const char* name : {"x", "y", "z"}) header += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"})
    header += fmt::format("property uchar {}\n", name);
  return header + "property float sigma_m\nend_header\n";
}

}  // namespace

std::string to_ply(const std::vector<ColouredPoint>& points, NumberForm form,
                   const std::vector<std::string>& comments) {
  std::string ply = ply_points_header(points.size(), form, comments);
  if (form == NumberForm::kBinary) {
    for (const ColouredPoint& point : points) {
      for (int i = 0; i < 3; ++i) append_number(ply, static_cast<float>(point.position[i]));
      for (const std::uint8_t value : point.rgb) append_number(ply, value);
      append_number(ply, static_cast<float>(point.sigma));
    }
    return ply;
  }
  const auto out = std::back_inserter(ply);
  for (const ColouredPoint& point : points)
    fmt::format_to(out, "{} {} {} {} {} {} {}\n", static_cast<float>(point.position[0]),
                   static_cast<float>(point.position[1]), static_cast<float>(point.position[2]),
                   point.rgb[0], point.rgb[1], point.rgb[2], static_cast<float>(point.sigma));
  return ply;
}

}  // namespace placegraph
