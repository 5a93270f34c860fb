#include "apps/image/scene/plane_truth.h"
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>

#include <cmath>

namespace placegraph::apps {

std::vector<Eigen::Vector4d> read_planes(const std::string& path) {
  TextFile file(path);
  std::vector<Eigen::Vector4d> planes;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 4)
      file.fail("four numbers nx ny nz d expected, found " + std::to_string(fields.size()));
    Eigen::Vector4d plane;
    for (int i = 0; i < 4; ++i) plane[i] = file.number(fields[i], "plane");
    if (!planes.empty() && std::abs(plane.head<3>().norm() - 1) > 1e-3)
      file.fail("the normal is not of unit length");
    planes.push_back(plane);
  }
  if (planes.empty()) throw FileError(path, "holds no plane");
  return planes;
}

}  // namespace placegraph::apps
