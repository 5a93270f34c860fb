#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/datasets/seven_scenes.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>

#include <filesystem>
#include <map>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

// The Kinect's rate; the files have no times.
constexpr double kRateHz = 30;
const std::string kPrefix = "frame-";

/// The files of a frame; paths of missing files are empty.
struct SceneFrame {
  std::string colour, depth, pose;
};

std::map<std::int64_t, SceneFrame> frames_in(const fs::path& folder) {
  std::map<std::int64_t, SceneFrame> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::size_t dot = name.find('.');
    if (!name.starts_with(kPrefix) || dot == name.npos) continue;
    const auto number =
        parse_integer(std::string_view(name).substr(kPrefix.size(), dot - kPrefix.size()));
    if (!number || *number < 0) continue;
    const std::string kind = name.substr(dot + 1);
    SceneFrame& frame = frames[*number];
    if (kind.starts_with("color.")) frame.colour = entry.path().string();
    if (kind.starts_with("depth.")) frame.depth = entry.path().string();
    if (kind == "pose.txt") frame.pose = entry.path().string();
  }
  return frames;
}

/// Reads four lines of four numbers; nothing if one is not finite.
std::optional<Eigen::Isometry3d> read_pose(const std::string& path) {
  TextFile file(path);
  Eigen::Matrix4d T;
  std::string_view line;
  std::vector<std::string_view> fields;
  for (int row = 0; row < 4; ++row) {
    if (!file.next_data(line)) throw FileError(path, "holds fewer than four lines of a matrix");
    split_blank(line, fields);
    if (fields.size() != 4) file.fail(fmt::format("expected 4 numbers, found {}", fields.size()));
    for (int column = 0; column < 4; ++column)
      T(row, column) = file.number_or_nan(fields[static_cast<std::size_t>(column)], "pose");
  }
  if (!T.allFinite()) return std::nullopt;
  try {
    return SE3(Eigen::Matrix3d(T.topLeftCorner<3, 3>()), Eigen::Vector3d(T.topRightCorner<3, 1>()))
        .isometry();
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
}

/// The calibration of calibration.yaml, else the usual one for these data.
CalibrationYaml read_calibration(const fs::path& folder, const Image& first,
                                 RecordedSequence& sequence) {
  CalibrationYaml yaml;
  const fs::path above = fs::absolute(folder / "").lexically_normal().parent_path().parent_path();
  for (const fs::path& at : {folder, above})
    if (fs::exists(at / "calibration.yaml")) {
      read_calibration_yaml((at / "calibration.yaml").string(), yaml);
      return yaml;
    }
  // Those of docs/datasets.md.
  constexpr double kColourFocal = 525, kDepthFocal = 585, kWidth = 640;
  const double scale = first.cols / kWidth;
  yaml.width = yaml.depth.width = first.cols;
  yaml.height = yaml.depth.height = first.rows;
  yaml.fx = yaml.fy = kColourFocal * scale;
  yaml.depth.fx = yaml.depth.fy = kDepthFocal * scale;
  yaml.cx = yaml.depth.cx = 0.5 * first.cols;
  yaml.cy = yaml.depth.cy = 0.5 * first.rows;
  sequence.notes.push_back({fmt::format(
      "7-Scenes has no calibration: focal lengths of {:g} px (colour) and {:g} px "
      "(depth) are assumed, both cameras at one position; a calibration.yaml is more accurate",
      yaml.fx, yaml.depth.fx)});
  return yaml;
}

}  // namespace

bool is_seven_scenes(const std::string& folder) {
  for (const char* extension : {"png", "jpg"})
    if (fs::exists(fs::path(folder) / (kPrefix + "000000.color." + extension))) return true;
  return false;
}

std::unique_ptr<Dataset> open_seven_scenes(const std::string& folder) {
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "7scenes";
  const auto frames = frames_in(folder);
  Trajectory truth;
  for (const auto& [number, frame] : frames) {
    if (frame.colour.empty() || frame.depth.empty()) continue;
    sequence.left.push_back(frame.colour);
    sequence.depth.push_back(frame.depth);
    sequence.stamps_ns.push_back(std::llround(static_cast<double>(number) * 1e9 / kRateHz));
    StampedPose pose{sequence.stamps_ns.back(), std::nullopt};
    if (!frame.pose.empty()) pose.T_world_body = read_pose(frame.pose);
    truth.poses.push_back(pose);
  }
  if (sequence.left.empty())
    throw FileError(folder, "no frame has both a colour and a depth image");
  if (sequence.left.size() < frames.size())
    sequence.notes.push_back(
        {fmt::format("{} of {} frames are skipped: without a colour or a depth image",
                     frames.size() - sequence.left.size(), frames.size())});
  const Image first = read_image(sequence.left[0]).grey;
  CalibrationYaml yaml = read_calibration(folder, first, sequence);
  if (auto note = fit_to_image(sequence.left[0], first, yaml)) sequence.notes.push_back(*note);
  const UndistortedCamera undistorted = undistort_plausibly(folder, yaml.camera());
  sequence.raw_camera = yaml.camera().camera;
  sequence.calibration.camera = undistorted.camera;
  sequence.left_remap = undistorted.remap;
  sequence.depth_unit_m = yaml.depth.unit_m;
  sequence.calibration.depth = yaml.depth_camera();
  if (yaml.depth.fx == 0) {  // registered: it shares the lens distortion of the image
    sequence.calibration.depth->camera = undistorted.camera;
    sequence.depth_remap = undistorted.remap;
  }
  if (truth.posed() > 0) sequence.ground_truth = std::move(truth);
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
