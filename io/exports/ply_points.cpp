#include <fmt/format.h>
#include <placegraph/io/files/little_endian.h>
#include <placegraph/io/exports/ply_header.h>
#include <placegraph/io/exports/ply_points.h>

#include <iterator>

namespace placegraph {

std::string to_ply(const std::vector<ColouredPoint>& points, NumberForm form,
                   const std::vector<std::string>& comments) {
  std::string ply = ply_header(form, comments,
                               {{"vertex",
                                 points.size(),
                                 {{"float", "x"},
                                  {"float", "y"},
                                  {"float", "z"},
                                  {"uchar", "red"},
                                  {"uchar", "green"},
                                  {"uchar", "blue"},
                                  {"float", "sigma_m"}}}});
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
