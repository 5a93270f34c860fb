#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_bytes.h>
#include <placegraph/io/exports/colmap_cameras.h>
#include <placegraph/io/exports/colmap_images.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <filesystem>
#include <unordered_map>

namespace placegraph {
namespace {

/// What the files have in common: points are found by their ids when all of them are read.
struct ColmapParts {
  ColmapModel model;
  std::vector<std::uint32_t> image_cameras;                 ///< id of the camera of each image
  std::vector<std::vector<ColmapImagePoint>> image_points;  ///< those of each image

  void take(ColmapImages images) {
    model.images = std::move(images.images);
    image_cameras = std::move(images.cameras);
    image_points = std::move(images.points);
  }
};

void read_binary_points(const std::string& path, ColmapParts& parts) {
  ColmapBytes bytes(path);
  const auto count = bytes.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    ColmapModel::Point& point = parts.model.points.emplace_back();
    point.id = bytes.next<std::uint64_t>();
    for (int k = 0; k < 3; ++k) point.p_world[k] = bytes.next_finite();
    for (std::uint8_t& value : point.rgb) value = bytes.next<std::uint8_t>();
    point.error_px = bytes.next<double>();
    const auto track = bytes.next<std::uint64_t>();  // the images have it, too
    for (std::uint64_t k = 0; k < track; ++k) bytes.next<std::uint64_t>();
  }
  bytes.end();
}

void read_text_points(const std::string& path, ColmapParts& parts) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() < 8) file.fail("not a point: id, position, colour and error are 8 fields");
    ColmapModel::Point& point = parts.model.points.emplace_back();
    point.id = static_cast<std::uint64_t>(file.integer(fields[0], "id"));
    for (std::size_t i = 0; i < 3; ++i) {
      point.p_world[static_cast<Eigen::Index>(i)] = file.number(fields[1 + i], "position");
      const std::int64_t value = file.integer(fields[4 + i], "colour");
      if (value < 0 || value > 255) file.fail("colour: " + in_quotes(fields[4 + i]));
      point.rgb[i] = static_cast<std::uint8_t>(value);
    }
    point.error_px = file.number(fields[7], "error");
  }
}

bool is_readable(const ColmapModel::RawCamera& camera) {
  const ColmapLens* lens = find_colmap_lens(camera.model);
  return lens != nullptr && lens->focal > 0;
}

/// The id of the camera of all images; without images that of the first camera of a known model.
std::uint32_t used_camera(const std::string& path, const ColmapParts& parts,
                          const std::vector<ColmapModel::RawCamera>& cameras) {
  const std::vector<ColmapModel::Image>& images = parts.model.images;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::uint32_t first = parts.image_cameras[0], camera = parts.image_cameras[i];
    if (std::ranges::find(cameras, camera, &ColmapModel::RawCamera::id) == cameras.end())
      throw FileError(path, fmt::format("image {} ({}) has camera {}, which is not there",
                                        images[i].id, images[i].name, camera));
    if (camera != first)
      throw FileError(path, fmt::format("images {} ({}) and {} ({}) have cameras {} and {}, one "
                                        "camera of all images is read",
                                        images[0].id, images[0].name, images[i].id, images[i].name,
                                        first, camera));
  }
  if (!images.empty()) return parts.image_cameras.front();
  const auto readable = std::ranges::find_if(cameras, is_readable);
  return readable == cameras.end() ? cameras.front().id : readable->id;
}

/// Puts the camera of the images and those that no image has into the model.
void put_cameras(const std::string& path, std::uint32_t used, ColmapLenses lenses,
                 std::vector<ColmapModel::RawCamera> cameras, ColmapModel& model) {
  const auto found = std::ranges::find(cameras, used, &ColmapModel::RawCamera::id);
  model.camera = camera_of_colmap(path, *found, lenses);
  model.camera_id = used;
  cameras.erase(found);
  model.unused_cameras = std::move(cameras);
}

}  // namespace

NumberForm colmap_form(const std::string& folder) {
  namespace fs = std::filesystem;
  return fs::exists(fs::path(folder) / "cameras.bin") ? NumberForm::kBinary : NumberForm::kText;
}

ColmapModel read_colmap(const std::string& folder, ColmapLenses lenses) {
  namespace fs = std::filesystem;
  const bool binary = colmap_form(folder) == NumberForm::kBinary;
  const auto path = [&](const char* name) {
    return (fs::path(folder) / name).string() + (binary ? ".bin" : ".txt");
  };
  ColmapParts parts;
  std::vector<ColmapModel::RawCamera> cameras =
      (binary ? read_binary_cameras : read_text_cameras)(path("cameras"));
  parts.take((binary ? read_binary_images : read_text_images)(path("images")));
  const std::uint32_t used = used_camera(path("images"), parts, cameras);
  put_cameras(path("cameras"), used, lenses, std::move(cameras), parts.model);
  (binary ? read_binary_points : read_text_points)(path("points3D"), parts);
  std::unordered_map<std::uint64_t, int> points;
  for (std::size_t i = 0; i < parts.model.points.size(); ++i)
    points.emplace(parts.model.points[i].id, static_cast<int>(i));
  for (std::size_t i = 0; i < parts.model.images.size(); ++i)
    for (const ColmapImagePoint& seen : parts.image_points[i]) {
      const auto point = points.find(seen.point);
      if (point == points.end())
        throw FileError(path("images"), fmt::format("image {} has an observation of point {}, "
                                                    "which is not there",
                                                    parts.model.images[i].id, seen.point));
      parts.model.images[i].observations.push_back({seen.px, point->second});
    }
  return std::move(parts.model);
}

}  // namespace placegraph
