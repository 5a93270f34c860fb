#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_images.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/io/files/name_order.h>
#include <placegraph/io/trajectories/posed_images.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

// Times since 1973, in nanoseconds and in seconds: smaller numbers are those of frames.
constexpr std::int64_t kLeastImageTime_ns = 100'000'000'000'000'000;
constexpr double kImageRotationTolerance = 1e-2;
constexpr std::size_t kColmapFields = 10;  // of an image's first line

using NamedPoses = std::map<std::string, Eigen::Isometry3d>;

bool are_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

/// The name without folders and without an extension that is no number ("17.25" has none).
std::string stem_of(const std::string& name) {
  const fs::path file = fs::path(name).filename();
  const std::string extension = file.extension().string();
  return extension.size() > 1 && !are_digits(extension.substr(1)) ? file.stem().string()
                                                                   : file.string();
}

/// A name that is a time since 1970; nothing for another.
std::optional<std::int64_t> time_in(const std::string& stem) {
  const std::size_t point = stem.find('.');
  const bool decimal = point != stem.npos && are_digits(stem.substr(0, point)) &&
                       are_digits(stem.substr(point + 1));
  if (!decimal && !are_digits(stem)) return std::nullopt;
  const auto stamp_ns = decimal ? parse_seconds_as_ns(stem) : parse_integer(stem);
  return stamp_ns && *stamp_ns >= kLeastImageTime_ns ? stamp_ns : std::nullopt;
}

/// The last whole number in a name; nothing if there is none of 64 bits.
std::optional<std::int64_t> number_in(const std::string& stem) {
  const std::size_t last = stem.find_last_of("0123456789");
  if (last == stem.npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of("0123456789", last);
  const std::size_t first = before == stem.npos ? 0 : before + 1;
  return parse_integer(std::string_view(stem).substr(first, last + 1 - first));
}

/// The stamps that all names have; empty if one has none.
template <class Read>
std::vector<std::int64_t> stamps_in(const std::vector<std::string>& names, const Read& read) {
  std::vector<std::int64_t> stamps;
  for (const std::string& name : names)
    if (const std::optional<std::int64_t> stamp = read(stem_of(name))) stamps.push_back(*stamp);
  if (stamps.size() != names.size()) stamps.clear();
  return stamps;
}

Trajectory trajectory_of(const std::string& path, const NamedPoses& poses) {
  if (poses.empty()) throw FileError(path, "holds no posed images");
  std::vector<std::string> names;
  for (const auto& [name, T_world_cam] : poses) names.push_back(name);
  sort_by_name(names);
  Trajectory trajectory;
  std::vector<std::int64_t> stamps = stamps_in(names, time_in);
  trajectory.has_times = !stamps.empty();
  if (stamps.empty()) stamps = stamps_in(names, number_in);
  trajectory.numbered = !trajectory.has_times && !stamps.empty();
  for (std::size_t i = 0; i < names.size(); ++i)
    trajectory.poses.push_back(
        {stamps.empty() ? static_cast<std::int64_t>(i) : stamps[i], poses.at(names[i])});
  std::vector<std::size_t> order(names.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto stamp = [&](std::size_t i) { return trajectory.poses[i].stamp_ns; };
  std::ranges::stable_sort(order, {}, stamp);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (stamp(order[k]) == stamp(order[k - 1]))
      throw FileError(path, fmt::format("images {} and {} have one number, {}: a trajectory is of "
                                        "one camera",
                                        names[order[k - 1]], names[order[k]], stamp(order[k])));
  std::ranges::stable_sort(trajectory.poses, {}, &StampedPose::stamp_ns);
  return trajectory;
}

Trajectory trajectory_of(const std::string& path, const ColmapImages& read) {
  NamedPoses poses;
  for (const ColmapModel::Image& image : read.images)
    if (!poses.emplace(image.name, image.T_world_cam.isometry()).second)
      throw FileError(path, "two images are named " + in_quotes(image.name));
  return trajectory_of(path, poses);
}

/// The pose of a camera with OpenGL's axes, in ours.
Eigen::Isometry3d pose_of_opengl(const std::string& path, const std::string& name,
                                 const nlohmann::json& rows) {
  Eigen::Matrix4d T_world_opengl = Eigen::Matrix4d::Identity();
  const auto values = rows.get<std::vector<std::vector<double>>>();
  bool whole = values.size() == 3 || values.size() == 4;
  for (std::size_t i = 0; whole && i < values.size(); ++i) {
    whole = values[i].size() == 4;
    for (std::size_t k = 0; whole && k < 4; ++k)
      T_world_opengl(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = values[i][k];
  }
  const Eigen::Matrix3d R = T_world_opengl.topLeftCorner<3, 3>();
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  whole = whole && T_world_opengl.allFinite() && off <= kImageRotationTolerance &&
          R.determinant() > 0 && T_world_opengl.row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  if (!whole)
    throw FileError(path, "the transform_matrix of " + in_quotes(name) +
                              " is not that of a rigid motion");
  Eigen::Isometry3d T_world_cam;
  T_world_cam.matrix() = T_world_opengl * Eigen::Vector4d(1, -1, -1, 1).asDiagonal();
  return T_world_cam;
}

Trajectory read_transforms(const std::string& path) {
  const nlohmann::json document = read_json(path);
  if (!document.is_object() || !document.contains("frames"))
    throw FileError(path, "is JSON, but no transforms.json with frames of images");
  NamedPoses poses;
  try {
    for (const nlohmann::json& frame : document.at("frames")) {
      const auto name = frame.at("file_path").get<std::string>();
      if (!poses.emplace(name, pose_of_opengl(path, name, frame.at("transform_matrix"))).second)
        throw FileError(path, "two frames are of the image " + in_quotes(name));
    }
  } catch (const nlohmann::json::exception& error) {
    throw FileError(path, std::string("is no transforms.json: ") + error.what());
  }
  return trajectory_of(path, poses);
}

}  // namespace

bool is_binary_model(const std::string& path) { return fs::path(path).extension() == ".bin"; }

Trajectory read_binary_images_poses(const std::string& path) {
  return trajectory_of(path, read_binary_images(path));
}

std::optional<Trajectory> read_posed_images(TextFile& file) {
  std::string_view line;
  std::vector<std::string_view> fields;
  const bool has_line = file.next_data(line);
  if (has_line) split_blank(line, fields);
  file.rewind();
  if (has_line && line.front() == '{') return read_transforms(file.path());
  const bool colmap = fields.size() == kColmapFields && parse_integer(fields[0]) &&
                      parse_integer(fields[8]) && !parse_double(fields[9]);
  if (!colmap) return std::nullopt;
  return trajectory_of(file.path(), read_text_images(file.path()));
}

}  // namespace placegraph
