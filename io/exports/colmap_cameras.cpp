#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_bytes.h>
#include <placegraph/io/exports/colmap_cameras.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

namespace placegraph {
namespace {

/// COLMAP's id of no camera.
constexpr std::uint32_t kNoColmapCamera = std::numeric_limits<std::uint32_t>::max();

constexpr ColmapLens kColmapLenses[] = {
    {"SIMPLE_PINHOLE", 0, 3, 1, Distortion::kNone},
    {"PINHOLE", 1, 4, 2, Distortion::kNone},
    {"SIMPLE_RADIAL", 2, 4, 1, Distortion::kRadialTangential},
    {"RADIAL", 3, 5, 1, Distortion::kRadialTangential},
    {"OPENCV", 4, 8, 2, Distortion::kRadialTangential},
    {"OPENCV_FISHEYE", 5, 8, 2, Distortion::kEquidistant},
    {"FULL_OPENCV", 6, 12, 0, Distortion::kNone},
    {"FOV", 7, 5, 0, Distortion::kNone},
    {"SIMPLE_RADIAL_FISHEYE", 8, 4, 0, Distortion::kNone},
    {"RADIAL_FISHEYE", 9, 5, 0, Distortion::kNone},
    {"THIN_PRISM_FISHEYE", 10, 12, 0, Distortion::kNone},
    {"RAD_TAN_THIN_PRISM_FISHEYE", 11, 16, 0, Distortion::kNone},
    {"SIMPLE_DIVISION", 12, 4, 0, Distortion::kNone},
    {"DIVISION", 13, 5, 0, Distortion::kNone},
    {"SIMPLE_FISHEYE", 14, 3, 0, Distortion::kNone},
    {"FISHEYE", 15, 4, 0, Distortion::kNone},
    {"EUCM", 16, 6, 0, Distortion::kNone},
    {"EQUIRECTANGULAR", 17, 2, 0, Distortion::kNone}};

/// The cameras of a file as they are read.
class CameraList {
 public:
  /// Adds a camera; false if its id is there already.
  bool add(ColmapModel::RawCamera camera) {
    const bool added = ids_.insert(camera.id).second;
    cameras_.push_back(std::move(camera));
    return added;
  }
  std::vector<ColmapModel::RawCamera> finish(const std::string& path) {
    if (cameras_.empty()) throw FileError(path, "no camera in it");
    return std::move(cameras_);
  }

 private:
  std::vector<ColmapModel::RawCamera> cameras_;
  std::set<std::uint32_t> ids_;
};

std::string no_id(std::int64_t id) { return fmt::format("camera: {} is no id", id); }

std::string there_twice(std::uint32_t id) { return fmt::format("camera {} is there twice", id); }

ColmapModel::RawCamera parse_camera_line(const TextFile& file,
                                         const std::vector<std::string_view>& fields) {
  if (fields.size() < 4) file.fail("not a camera");
  ColmapModel::RawCamera camera;
  camera.id = colmap_camera_id(file, fields[0]);
  camera.model = fields[1];
  const ColmapLens* lens = find_colmap_lens(camera.model);
  if (lens != nullptr && fields.size() != 4 + lens->parameters)
    file.fail(fmt::format("{} has {} parameters", camera.model, lens->parameters));
  const std::int64_t width = file.integer(fields[2], "width");
  const std::int64_t height = file.integer(fields[3], "height");
  if (width < 0 || height < 0) file.fail("the size of the image is negative");
  camera.width = static_cast<std::uint64_t>(width);
  camera.height = static_cast<std::uint64_t>(height);
  for (std::size_t i = 4; i < fields.size(); ++i)
    camera.parameters.push_back(file.number(fields[i], "camera"));
  return camera;
}

}  // namespace

const ColmapLens* find_colmap_lens(std::string_view name) {
  const auto* found = std::ranges::find(kColmapLenses, name, &ColmapLens::name);
  return found == std::end(kColmapLenses) ? nullptr : found;
}

std::vector<ColmapModel::RawCamera> read_binary_cameras(const std::string& path) {
  ColmapBytes bytes(path);
  const auto count = bytes.next<std::uint64_t>();
  CameraList cameras;
  for (std::uint64_t i = 0; i < count; ++i) {
    ColmapModel::RawCamera camera;
    camera.id = bytes.next<std::uint32_t>();
    if (camera.id == kNoColmapCamera) throw FileError(path, no_id(camera.id));
    const auto model = bytes.next<std::int32_t>();
    const auto* lens = std::ranges::find(kColmapLenses, model, &ColmapLens::id);
    if (lens == std::end(kColmapLenses))
      throw FileError(path,
                      fmt::format("camera {} has the unknown model {}: what follows it cannot "
                                  "be read",
                                  camera.id, model));
    camera.model = lens->name;
    camera.width = bytes.next<std::uint64_t>();
    camera.height = bytes.next<std::uint64_t>();
    for (std::size_t k = 0; k < lens->parameters; ++k)
      camera.parameters.push_back(bytes.next_finite());
    const std::uint32_t id = camera.id;
    if (!cameras.add(std::move(camera))) throw FileError(path, there_twice(id));
  }
  bytes.end();
  return cameras.finish(path);
}

std::vector<ColmapModel::RawCamera> read_text_cameras(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  CameraList cameras;
  while (file.next_data(line)) {
    split_blank(line, fields);
    ColmapModel::RawCamera camera = parse_camera_line(file, fields);
    const std::uint32_t id = camera.id;
    if (!cameras.add(std::move(camera))) file.fail(there_twice(id));
  }
  return cameras.finish(path);
}

std::uint32_t colmap_camera_id(const TextFile& file, std::string_view field) {
  const std::int64_t id = file.integer(field, "camera");
  if (id < 0 || id >= kNoColmapCamera) file.fail(no_id(id));
  return static_cast<std::uint32_t>(id);
}

Camera camera_of_colmap(const std::string& path, const ColmapModel::RawCamera& raw,
                        ColmapLenses lenses) {
  const ColmapLens* lens = find_colmap_lens(raw.model);
  const bool any = lenses == ColmapLenses::kAny;
  if (lens == nullptr || lens->focal == 0 || (!any && lens->distortion != Distortion::kNone))
    throw FileError(path, "camera model " + raw.model +
                              (any ? ": PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and "
                                     "OPENCV_FISHEYE are read"
                                   : ": PINHOLE and SIMPLE_PINHOLE are read; undistort the images "
                                     "before"));
  constexpr std::uint64_t kMost = 1 << 20;
  if (raw.width == 0 || raw.height == 0 || raw.width > kMost || raw.height > kMost)
    throw FileError(path,
                    fmt::format("{} x {} is not the size of an image", raw.width, raw.height));
  Camera camera;
  camera.width = static_cast<int>(raw.width);
  camera.height = static_cast<int>(raw.height);
  camera.fx = raw.parameters[0];
  camera.fy = raw.parameters[lens->focal - 1];
  camera.cx = raw.parameters[lens->focal] - kColmapCorner_px;
  camera.cy = raw.parameters[lens->focal + 1] - kColmapCorner_px;
  camera.distortion = lens->distortion;
  for (std::size_t i = lens->focal + 2; i < raw.parameters.size(); ++i)
    camera.coefficients[i - lens->focal - 2] = raw.parameters[i];
  if (!(camera.fx > 0) || !(camera.fy > 0)) throw FileError(path, "a focal length is not positive");
  return camera;
}

}  // namespace placegraph
