#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/point_cloud_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

namespace placegraph {
namespace {

constexpr double kMost = 1e6;                    ///< largest accepted coordinate [m]
constexpr std::uintmax_t kLargest = 1ull << 31;  ///< largest accepted file [bytes]

std::string read_bytes(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw FileError(path, "cannot be read: " + error.message());
  if (size > kLargest) throw FileError(path, "larger than 2 GiB");
  require_input_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path, "cannot be opened");
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw FileError(path, "cannot be read");
  return bytes;
}

bool sound(const Eigen::Vector3d& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMost; }

void require_sound(const std::string& path, std::size_t i, const Eigen::Vector3d& p) {
  if (!sound(p))
    throw FileError(path, "point " + std::to_string(i) + " is not finite or above 1e6 m");
}

double coordinate(const TextFile& file, std::string_view field, const char* name) {
  const double value = file.number(field, name);
  if (std::abs(value) > kMost)
    file.fail(std::string(name) + ": " + in_quotes(field) + " is above 1e6 m");
  return value;
}

PointCloud read_text(const std::string& path) {
  TextFile file(path);
  PointCloud cloud;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() < 3)
      file.fail(std::to_string(fields.size()) + " columns, at least 3 expected: x y z");
    cloud.points.emplace_back(coordinate(file, fields[0], "x"), coordinate(file, fields[1], "y"),
                              coordinate(file, fields[2], "z"));
  }
  return cloud;
}

PointCloud read_kitti_cloud(const std::string& path) {
  constexpr std::size_t kPoint = 4 * sizeof(float);
  const std::string bytes = read_bytes(path);
  if (bytes.size() % kPoint != 0)
    throw FileError(path, std::to_string(bytes.size()) +
                              " bytes are not a whole number of points of four float32");
  PointCloud cloud;
  for (std::size_t i = 0; i * kPoint < bytes.size(); ++i) {
    float values[4];
    std::memcpy(values, bytes.data() + i * kPoint, kPoint);
    cloud.points.emplace_back(values[0], values[1], values[2]);
    require_sound(path, i, cloud.points.back());
  }
  return cloud;
}

/// A type of a PLY property: its size, and whether it is valid for a coordinate.
struct PlyType {
  std::size_t size = 0;
  bool is_float = false, is_double = false;
};

PlyType ply_type(std::string_view name) {
  if (name == "float" || name == "float32") return {4, true, false};
  if (name == "double" || name == "float64") return {8, false, true};
  if (name == "char" || name == "int8" || name == "uchar" || name == "uint8") return {1};
  if (name == "short" || name == "int16" || name == "ushort" || name == "uint16") return {2};
  if (name == "int" || name == "int32" || name == "uint" || name == "uint32") return {4};
  return {};
}

struct PlyHeader {
  bool binary = false;
  std::int64_t vertices = -1;
  std::size_t stride = 0, columns = 0;  ///< bytes and columns of a vertex
  std::array<std::size_t, 3> offset{}, column{};
  std::array<PlyType, 3> type{};
  std::size_t body = 0;  ///< [bytes] where the vertices begin
  int lines = 0;
};

/// Reads the header line by line; nothing in it sizes an allocation.
PlyHeader read_ply_header(const std::string& path, const std::string& bytes) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  PlyHeader header;
  std::array<bool, 3> has{};
  bool in_vertices = false, has_format = false;
  std::size_t at = 0;
  const auto fail = [&](const std::string& what) { throw FileError(path, header.lines, what); };
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = bytes.find('\n', at);
    ++header.lines;
    if (end == std::string::npos || end > kLongestHeader) fail("no end_header in a PLY header");
    std::string_view line(bytes.data() + at, end - at);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at = end + 1;
    split_blank(line, fields);
    if (header.lines == 1) {
      if (line != "ply") fail("a PLY file begins with \"ply\"");
      continue;
    }
    if (fields.empty() || fields[0] == "comment" || fields[0] == "obj_info") continue;
    if (fields[0] == "end_header") break;
    if (fields[0] == "format" && fields.size() == 3) {
      has_format = true;
      header.binary = fields[1] == "binary_little_endian";
      if (!header.binary && fields[1] != "ascii")
        fail(in_quotes(fields[1]) + ": neither ascii nor binary_little_endian");
    } else if (fields[0] == "element" && fields.size() == 3) {
      in_vertices = fields[1] == "vertex";
      const auto count = parse_integer(fields[2]);
      if (!count || *count < 0) fail("element: " + in_quotes(fields[2]) + " is not a count");
      if (in_vertices && header.vertices >= 0) fail("a second element vertex");
      if (in_vertices) header.vertices = *count;
      if (!in_vertices && header.vertices < 0 && *count > 0)
        fail("elements before the vertices are not read");
    } else if (fields[0] == "property" && in_vertices) {
      if (fields.size() != 3) fail("vertices with lists are not read");
      const PlyType type = ply_type(fields[1]);
      if (type.size == 0) fail(in_quotes(fields[1]) + " is not a type of a property");
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (fields[2] == std::array{"x", "y", "z"}[axis]) {
          if (!type.is_float && !type.is_double) fail("x, y and z are float or double");
          has[axis] = true;
          header.offset[axis] = header.stride, header.column[axis] = header.columns;
          header.type[axis] = type;
        }
      header.stride += type.size;
      ++header.columns;
    } else if (fields[0] != "property") {
      fail(in_quotes(line) + " is not a line of a PLY header");
    }
  }
  if (!has_format) fail("no format line in a PLY header");
  if (header.vertices < 0) fail("no vertices in a PLY header");
  if (!has[0] || !has[1] || !has[2]) fail("vertices without x, y and z");
  header.body = at;
  return header;
}

PointCloud read_ply(const std::string& path) {
  const std::string bytes = read_bytes(path);
  const PlyHeader header = read_ply_header(path, bytes);
  const auto count = static_cast<std::uint64_t>(header.vertices);
  PointCloud cloud;
  if (header.binary) {
    if (count > (bytes.size() - header.body) / header.stride)
      throw FileError(path, "truncated: " + std::to_string(bytes.size() - header.body) +
                                " bytes for " + std::to_string(count) + " vertices of " +
                                std::to_string(header.stride));
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3d p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const char* from = bytes.data() + header.body + i * header.stride + header.offset[axis];
        float single = 0;
        double wide = 0;
        if (header.type[axis].is_float)
          std::memcpy(&single, from, sizeof single), wide = single;
        else
          std::memcpy(&wide, from, sizeof wide);
        p[static_cast<Eigen::Index>(axis)] = wide;
      }
      require_sound(path, i, p);
      cloud.points.push_back(p);
    }
    return cloud;
  }
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  for (int i = 0; i < header.lines; ++i) file.next(line);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!file.next(line))
      throw FileError(path,
                      "truncated: " + std::to_string(i) + " vertices of " + std::to_string(count));
    split_blank(line, fields);
    if (fields.size() < header.columns)
      file.fail(std::to_string(fields.size()) + " columns, " + std::to_string(header.columns) +
                " expected");
    cloud.points.emplace_back(coordinate(file, fields[header.column[0]], "x"),
                              coordinate(file, fields[header.column[1]], "y"),
                              coordinate(file, fields[header.column[2]], "z"));
  }
  return cloud;
}

}  // namespace

PointCloud read_point_cloud(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw FileError(path, "a folder, not a cloud");
  const std::string extension = std::filesystem::path(path).extension().string();
  PointCloud cloud = extension == ".ply"   ? read_ply(path)
                     : extension == ".bin" ? read_kitti_cloud(path)
                                           : read_text(path);
  if (cloud.points.empty()) throw FileError(path, "no point in it");
  // Depth cameras write the sensor's own position for a ray without a measurement.
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::replace(cloud.points.begin(), cloud.points.end(), Eigen::Vector3d(0, 0, 0), none);
  return cloud;
}

PointCloud cloud_of_depth(const Image& depth, const Camera& camera, double step_m) {
  require(depth.type() == CV_32FC1, "depth: not CV_32FC1");
  require(depth.cols == camera.width && depth.rows == camera.height,
          "depth: not of the camera's size");
  require(camera.distortion == Distortion::kNone, "depth: of a camera with distortion");
  PointCloud cloud;
  cloud.width = depth.cols, cloud.height = depth.rows, cloud.step_m = step_m;
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  cloud.points.reserve(static_cast<std::size_t>(depth.cols) * static_cast<std::size_t>(depth.rows));
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      const double z = depth.at<float>(y, x);
      cloud.points.push_back(z > 0 ? Eigen::Vector3d((x - camera.cx) / camera.fx * z,
                                                     (y - camera.cy) / camera.fy * z, z)
                                   : none);
    }
  return cloud;
}

std::vector<int> read_point_labels(const std::string& path) {
  TextFile file(path);
  std::vector<int> labels;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 1 && fields.size() < 4)
      file.fail(std::to_string(fields.size()) + " columns: neither a label nor x y z label");
    const std::int64_t label = file.integer(fields.size() == 1 ? fields[0] : fields[3], "label");
    if (label < 0 || label > 1'000'000)
      file.fail("label: " + in_quotes(fields.back()) + " is out of range");
    labels.push_back(static_cast<int>(label));
  }
  return labels;
}

}  // namespace placegraph
