#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/kitti_calibration.h>
#include <placegraph/io/datasets/kitti_drive.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/sensors/oxts_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>
#include <map>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

fs::path camera_folder(const fs::path& drive, int camera) {
  return drive / fmt::format("image_{:02d}", camera);
}

/// The images of a camera by their numbers.
std::map<std::int64_t, std::string> numbered_images(const fs::path& data) {
  std::map<std::int64_t, std::string> images;
  for (const std::string& path : list_images(data.string())) {
    const auto number = parse_integer(fs::path(path).stem().string());
    if (!number || *number < 0)
      throw FileError(path, "is not an image of a drive: 0000000000.png, 0000000001.png, ...");
    images.emplace(*number, path);
  }
  return images;
}

std::string calibration_file(const fs::path& drive) {
  const fs::path above = fs::absolute(drive / "").lexically_normal().parent_path().parent_path();
  for (const fs::path& folder : {drive, above})
    for (const char* name : {"calib_cam_to_cam.txt", "calib.txt"})
      if (fs::exists(folder / name)) return (folder / name).string();
  throw FileError(drive.string(),
                  "a drive of KITTI raw, but neither it nor the folder above it holds "
                  "calib_cam_to_cam.txt (the archive 2011_.._calib.zip) or calib.txt");
}

/// Takes the images of both cameras by their numbers; those without a partner are counted.
void take_images(const fs::path& drive, int left, bool has_right, RecordedSequence& sequence,
                 std::vector<std::int64_t>& numbers) {
  const auto lefts = numbered_images(camera_folder(drive, left) / "data");
  std::map<std::int64_t, std::string> rights;
  if (has_right) rights = numbered_images(camera_folder(drive, left + 1) / "data");
  for (const auto& [number, path] : lefts) {
    if (has_right && !rights.contains(number)) continue;
    sequence.left.push_back(path);
    if (has_right) sequence.right.push_back(rights.at(number));
    numbers.push_back(number);
  }
  if (numbers.empty())
    throw FileError(drive.string(),
                    "no image of the left camera has a partner from the right camera");
  if (has_right && numbers.size() < std::max(lefts.size(), rights.size()))
    sequence.notes.push_back({fmt::format(
        "{} of {} images of the left camera and {} of {} of the right camera are skipped: the "
        "other camera has none of that number",
        lefts.size() - numbers.size(), lefts.size(), rights.size() - numbers.size(),
        rights.size())});
}

/// Times of the images relative to the first one, by their numbers, which are line numbers.
void take_times(const fs::path& drive, int left, const std::vector<std::int64_t>& numbers,
                RecordedSequence& sequence) {
  const fs::path path = camera_folder(drive, left) / "timestamps.txt";
  if (!fs::exists(path)) {
    sequence.stamps_ns = synthetic_stamps_ns(numbers.size());
    sequence.notes.push_back(
        {fmt::format("{} is missing: times are counted at {:g} Hz",
                     path.lexically_relative(drive).string(), kDefaultRateHz)});
    return;
  }
  const std::vector<std::int64_t> stamps_ns = read_kitti_times(path.string());
  for (const std::int64_t number : numbers) {
    if (number >= static_cast<std::int64_t>(stamps_ns.size()))
      throw FileError(path.string(), fmt::format("holds {} times, but there is an image {}",
                                                 stamps_ns.size(), number));
    sequence.stamps_ns.push_back(stamps_ns[static_cast<std::size_t>(number)] -
                                 stamps_ns[static_cast<std::size_t>(numbers.front())]);
  }
}

/// Rejects images whose size differs from that of the rectified images in the calibration.
void require_rectified(const std::string& path, int left, const std::string& image_path,
                       const Image& image) {
  const std::string key = fmt::format("S_rect_{:02d}", left);
  const auto lines = read_kitti_lines(path, {{key, 2}});
  const auto size = lines.find(key);
  if (size == lines.end()) return;
  const double width = size->second.numbers[0], height = size->second.numbers[1];
  if (image.cols == width && image.rows == height) return;
  throw FileError(image_path,
                  fmt::format("is {} x {}, but {}:{} says {:g} x {:g}: the synced and rectified "
                              "drive (_sync) is needed, not the raw one (_extract)",
                              image.cols, image.rows, path, size->second.line, width, height));
}

void take_truth(const fs::path& path, const Eigen::Vector3d& position_in_cam0,
                const std::vector<std::int64_t>& numbers, RecordedSequence& sequence) {
  if (!fs::exists(path)) return;
  const Trajectory poses = read_frame_poses(path.string());
  Trajectory truth;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = static_cast<std::size_t>(numbers[i]);
    if (number >= poses.size())
      throw FileError(path.string(), fmt::format("holds {} poses, but there is an image {}",
                                                 poses.size(), number));
    StampedPose pose{sequence.stamps_ns[i], poses.poses[number].T_world_body};
    if (pose.T_world_body) pose.T_world_body->translate(position_in_cam0);
    truth.poses.push_back(pose);
  }
  sequence.ground_truth = std::move(truth);
}

}  // namespace

bool is_kitti_drive(const std::string& folder) {
  return fs::is_directory(camera_folder(folder, 0) / "data") ||
         fs::is_directory(camera_folder(folder, 2) / "data");
}

std::unique_ptr<Dataset> open_kitti_drive(const std::string& folder) {
  const fs::path drive(folder);
  const int left = fs::is_directory(camera_folder(drive, 0) / "data") ? 0 : 2;
  const std::string calibration = calibration_file(drive);
  const KittiCameras cameras = read_kitti_cameras(
      calibration, left, fs::is_directory(camera_folder(drive, left + 1) / "data"));
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "kitti_raw";
  sequence.rectified = true;
  std::vector<std::int64_t> numbers;
  take_images(drive, left, cameras.baseline_m > 0, sequence, numbers);
  take_times(drive, left, numbers, sequence);
  const Image first = read_image(sequence.left[0]).grey;
  require_rectified(calibration, left, sequence.left[0], first);
  sequence.calibration.camera = cameras.camera;
  set_size(sequence.left[0], first, sequence.calibration.camera);
  require_plausible_camera(calibration, sequence.calibration.camera);
  sequence.raw_camera = sequence.calibration.camera;
  sequence.calibration.baseline_m = cameras.baseline_m;
  take_truth(drive / "poses.txt", cameras.position_in_cam0, numbers, sequence);
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
