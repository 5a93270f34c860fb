#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_bytes.h>
#include <placegraph/io/exports/colmap_cameras.h>
#include <placegraph/io/exports/colmap_images.h>
#include <placegraph/io/files/text_file.h>

#include <array>

namespace placegraph {
namespace {

SE3 pose_from_colmap(const std::string& path, const std::array<double, 7>& numbers) {
  const Eigen::Quaterniond q(numbers[0], numbers[1], numbers[2], numbers[3]);
  if (!(q.norm() > 1e-6)) throw FileError(path, "the quaternion of a pose is zero");
  return SE3(SO3(q.normalized()), {numbers[4], numbers[5], numbers[6]}).inverse();
}

}  // namespace

ColmapImages read_binary_images(const std::string& path) {
  ColmapImages read;
  ColmapBytes bytes(path);
  const auto count = bytes.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    ColmapModel::Image& image = read.images.emplace_back();
    image.id = bytes.next<std::uint32_t>();
    std::array<double, 7> pose{};
    for (double& number : pose) number = bytes.next_finite();
    image.T_world_cam = pose_from_colmap(path, pose);
    read.cameras.push_back(bytes.next<std::uint32_t>());
    image.name = bytes.next_name();
    std::vector<ColmapImagePoint>& points = read.points.emplace_back();
    const auto observations = bytes.next<std::uint64_t>();
    for (std::uint64_t k = 0; k < observations; ++k) {
      const double x = bytes.next_finite(), y = bytes.next_finite();
      const auto point = bytes.next<std::uint64_t>();
      if (point != kNoColmapPoint)
        points.push_back({{x - kColmapCorner_px, y - kColmapCorner_px}, point});
    }
  }
  bytes.end();
  return read;
}

ColmapImages read_text_images(const std::string& path) {
  ColmapImages read;
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next(line)) {
    split_blank(line, fields);
    if (fields.empty() || fields[0][0] == '#') continue;
    if (fields.size() != 10) file.fail("not an image: id, pose, camera and name are 10 fields");
    ColmapModel::Image& image = read.images.emplace_back();
    image.id = static_cast<std::uint32_t>(file.integer(fields[0], "id"));
    std::array<double, 7> pose{};
    for (std::size_t i = 0; i < 7; ++i) pose[i] = file.number(fields[1 + i], "pose");
    image.T_world_cam = pose_from_colmap(path, pose);
    read.cameras.push_back(colmap_camera_id(file, fields[8]));
    image.name = fields[9];
    std::vector<ColmapImagePoint>& points = read.points.emplace_back();
    if (!file.next(line)) break;  // an image without image points at the end of the file
    split_blank(line, fields);
    if (fields.size() % 3 != 0) file.fail("image points are not x, y and the id of a point");
    for (std::size_t i = 0; i < fields.size(); i += 3) {
      const std::int64_t point = file.integer(fields[i + 2], "point");
      if (point >= 0)
        points.push_back({{file.number(fields[i], "x") - kColmapCorner_px,
                           file.number(fields[i + 1], "y") - kColmapCorner_px},
                          static_cast<std::uint64_t>(point)});
    }
  }
  return read;
}

}  // namespace placegraph
