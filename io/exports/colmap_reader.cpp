#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/io/exports/little_endian.h>
#include <placegraph/io/files/text_file.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <unordered_map>

namespace placegraph {
namespace {

constexpr double kColmapCorner_px = 0.5;  ///< pixels count from the corner of the first one
constexpr auto kNoColmapPoint = std::numeric_limits<std::uint64_t>::max();

/// An image point with the id of its point, as files have it.
struct ColmapImagePoint {
  Eigen::Vector2d px;
  std::uint64_t point = kNoColmapPoint;
};

/// What the files have in common: points are found by their ids when all of them are read.
struct ColmapParts {
  ColmapModel model;
  std::vector<std::vector<ColmapImagePoint>> image_points;  ///< those of each image
};

/// The numbers of a binary file, one after the other.
class ColmapBytes {
 public:
  explicit ColmapBytes(std::string path) : path_(std::move(path)) {
    require_input_file(path_);
    std::ifstream stream(path_, std::ios::binary);
    if (!stream) throw FileError(path_, "cannot be opened");
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
    if (stream.bad()) throw FileError(path_, "cannot be read");
  }
  template <class Number>
  Number next() {
    Number number{};
    if (bytes_.size() - at_ < sizeof number) throw FileError(path_, "truncated");
    std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  double next_finite() {
    const auto number = next<double>();
    if (!std::isfinite(number)) throw FileError(path_, "a number is not finite");
    return number;
  }
  std::string next_name() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) throw FileError(path_, "truncated");
    std::string name = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return name;
  }
  void end() const {
    if (at_ != bytes_.size()) throw FileError(path_, "bytes after the last entry");
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_, bytes_;
  std::size_t at_ = 0;
};

/// A model of cameras: its parameters are one or two focal lengths, cx, cy, and coefficients.
struct ColmapLens {
  const char* name;
  int id;                  ///< number in binary files
  std::size_t focal;       ///< number of focal lengths
  std::size_t parameters;  ///< number of all
  Distortion distortion;
};

constexpr ColmapLens kColmapLenses[] = {{"SIMPLE_PINHOLE", 0, 1, 3, Distortion::kNone},
                                        {"PINHOLE", 1, 2, 4, Distortion::kNone},
                                        {"SIMPLE_RADIAL", 2, 1, 4, Distortion::kRadialTangential},
                                        {"RADIAL", 3, 1, 5, Distortion::kRadialTangential},
                                        {"OPENCV", 4, 2, 8, Distortion::kRadialTangential},
                                        {"OPENCV_FISHEYE", 5, 2, 8, Distortion::kEquidistant}};

/// The model of a name or number; `what` is how a message names it.
template <class Matches>
const ColmapLens& find_colmap_lens(const std::string& path, const std::string& what,
                                   ColmapLenses lenses, Matches matches) {
  for (const ColmapLens& lens : kColmapLenses)
    if (matches(lens) && (lenses == ColmapLenses::kAny || lens.distortion == Distortion::kNone))
      return lens;
  throw FileError(path, "camera model " + what +
                            (lenses == ColmapLenses::kAny
                                 ? ": PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and "
                                   "OPENCV_FISHEYE are read"
                                 : ": PINHOLE and SIMPLE_PINHOLE are read; undistort the images "
                                   "before"));
}

Camera colmap_camera(const std::string& path, const ColmapLens& lens, std::uint64_t width,
                     std::uint64_t height, const std::vector<double>& parameters) {
  constexpr std::uint64_t kMost = 1 << 20;
  if (width == 0 || height == 0 || width > kMost || height > kMost)
    throw FileError(path, fmt::format("{} x {} is not the size of an image", width, height));
  Camera camera;
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  camera.fx = parameters[0];
  camera.fy = parameters[lens.focal - 1];
  camera.cx = parameters[lens.focal] - kColmapCorner_px;
  camera.cy = parameters[lens.focal + 1] - kColmapCorner_px;
  camera.distortion = lens.distortion;
  for (std::size_t i = lens.focal + 2; i < parameters.size(); ++i)
    camera.coefficients[i - lens.focal - 2] = parameters[i];
  if (!(camera.fx > 0) || !(camera.fy > 0)) throw FileError(path, "a focal length is not positive");
  return camera;
}

SE3 pose_from_colmap(const std::string& path, const std::array<double, 7>& numbers) {
  const Eigen::Quaterniond q(numbers[0], numbers[1], numbers[2], numbers[3]);
  if (!(q.norm() > 1e-6)) throw FileError(path, "the quaternion of a pose is zero");
  return SE3(SO3(q.normalized()), {numbers[4], numbers[5], numbers[6]}).inverse();
}

Camera read_binary_camera(const std::string& path, ColmapLenses lenses) {
  ColmapBytes bytes(path);
  if (const auto count = bytes.next<std::uint64_t>(); count != 1)
    throw FileError(path, fmt::format("{} cameras, one is read", count));
  bytes.next<std::uint32_t>();
  const auto id = bytes.next<std::int32_t>();
  const ColmapLens& lens = find_colmap_lens(path, std::to_string(id), lenses,
                                            [id](const ColmapLens& one) { return one.id == id; });
  const auto width = bytes.next<std::uint64_t>(), height = bytes.next<std::uint64_t>();
  std::vector<double> parameters;
  for (std::size_t i = 0; i < lens.parameters; ++i) parameters.push_back(bytes.next_finite());
  bytes.end();
  return colmap_camera(path, lens, width, height, parameters);
}

void read_binary_images(const std::string& path, ColmapParts& parts) {
  ColmapBytes bytes(path);
  const auto count = bytes.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    ColmapModel::Image& image = parts.model.images.emplace_back();
    image.id = bytes.next<std::uint32_t>();
    std::array<double, 7> pose{};
    for (double& number : pose) number = bytes.next_finite();
    image.T_world_cam = pose_from_colmap(path, pose);
    bytes.next<std::uint32_t>();
    image.name = bytes.next_name();
    std::vector<ColmapImagePoint>& points = parts.image_points.emplace_back();
    const auto observations = bytes.next<std::uint64_t>();
    for (std::uint64_t k = 0; k < observations; ++k) {
      const double x = bytes.next_finite(), y = bytes.next_finite();
      const auto point = bytes.next<std::uint64_t>();
      if (point != kNoColmapPoint)
        points.push_back({{x - kColmapCorner_px, y - kColmapCorner_px}, point});
    }
  }
  bytes.end();
}

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

Camera read_text_camera(const std::string& path, ColmapLenses lenses) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  if (!file.next_data(line)) throw FileError(path, "no camera in it");
  split_blank(line, fields);
  if (fields.size() < 4) file.fail("not a camera");
  const std::string name(fields[1]);
  const ColmapLens& lens = find_colmap_lens(
      path, name, lenses, [&name](const ColmapLens& one) { return one.name == name; });
  if (fields.size() != 4 + lens.parameters)
    file.fail(fmt::format("{} has {} parameters", name, lens.parameters));
  std::vector<double> values;
  for (std::size_t i = 4; i < fields.size(); ++i)
    values.push_back(file.number(fields[i], "camera"));
  const std::int64_t width = file.integer(fields[2], "width");
  const std::int64_t height = file.integer(fields[3], "height");
  if (width < 1 || height < 1) file.fail("the size of the image is not positive");
  if (file.next_data(line)) file.fail("a second camera, one is read");
  return colmap_camera(path, lens, static_cast<std::uint64_t>(width),
                       static_cast<std::uint64_t>(height), values);
}

void read_text_images(const std::string& path, ColmapParts& parts) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next(line)) {
    split_blank(line, fields);
    if (fields.empty() || fields[0][0] == '#') continue;
    if (fields.size() != 10) file.fail("not an image: id, pose, camera and name are 10 fields");
    ColmapModel::Image& image = parts.model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(file.integer(fields[0], "id"));
    std::array<double, 7> pose{};
    for (std::size_t i = 0; i < 7; ++i) pose[i] = file.number(fields[1 + i], "pose");
    image.T_world_cam = pose_from_colmap(path, pose);
    image.name = fields[9];
    std::vector<ColmapImagePoint>& points = parts.image_points.emplace_back();
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
  parts.model.camera = (binary ? read_binary_camera : read_text_camera)(path("cameras"), lenses);
  (binary ? read_binary_images : read_text_images)(path("images"), parts);
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
