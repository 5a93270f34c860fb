#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/image_folder.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

/// The last number in the name of an image: its frame number or its time.
std::optional<double> number_of(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  const std::size_t last = stem.find_last_of("0123456789");
  if (last == stem.npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of("0123456789.", last);
  std::string_view number(stem);
  number = number.substr(before == stem.npos ? 0 : before + 1, last - before);
  while (number.starts_with('.')) number.remove_prefix(1);
  return parse_double(number);
}

/// Rejects images whose numbers differ from those of the left ones, because pairs are formed by the
/// position in the folder. Times may differ by half of the time between two images.
void require_same_numbers(const std::vector<std::string>& left,
                          const std::vector<std::string>& images) {
  std::vector<double> of_left, of_images, steps;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const auto a = number_of(left[i]), b = number_of(images[i]);
    if (!a || !b) return;
    of_left.push_back(*a), of_images.push_back(*b);
    if (i > 0) steps.push_back(std::abs(of_left[i] - of_left[i - 1]));
  }
  if (steps.empty()) return;
  const double most = 0.5 * median_of(std::move(steps));
  for (std::size_t i = 0; i < left.size(); ++i)
    if (!(std::abs(of_left[i] - of_images[i]) <= most))
      throw FileError(images[i], "would be paired with " + fs::path(left[i]).filename().string() +
                                     ", image by image, but their numbers disagree");
}

std::vector<std::string> list_as_many(const fs::path& folder,
                                      const std::vector<std::string>& left) {
  std::vector<std::string> images = list_images(folder.string());
  if (images.size() != left.size())
    throw FileError(folder.string(), fmt::format("holds {} images, but there are {} left ones",
                                                 images.size(), left.size()));
  require_same_numbers(left, images);
  return images;
}

/// The folder of the (left) camera's images: the folder itself, or one of these inside it.
std::string folder_of_images(const fs::path& folder) {
  if (holds_images(folder.string())) return folder.string();
  for (const char* name : {"images", "image", "left", "rgb"})
    if (holds_images((folder / name).string())) return (folder / name).string();
  return folder.string();
}

void read_ground_truth(const fs::path& path, const SE3& T_left_rectified,
                       RecordedSequence& sequence) {
  if (!fs::exists(path)) return;
  Trajectory truth = read_frame_poses(path.string());
  if (truth.size() != sequence.left.size()) {
    throw FileError(path.string(), fmt::format("holds {} poses, but there are {} images",
                                               truth.size(), sequence.left.size()));
  }
  truth.has_times = true;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    StampedPose& pose = truth.poses[i];
    pose.stamp_ns = sequence.stamps_ns[i];
    if (pose.T_world_body) *pose.T_world_body = *pose.T_world_body * T_left_rectified.isometry();
  }
  sequence.ground_truth = std::move(truth);
}

/// Sets one camera, or a rectified pair with the baseline of `yaml`.
void take_cameras(const std::string& yaml_path, const CalibrationYaml& yaml, const fs::path& folder,
                  RecordedSequence& sequence) {
  const UndistortedCamera undistorted = undistort_plausibly(yaml_path, yaml.camera());
  sequence.calibration.camera = undistorted.camera;
  sequence.left_remap = undistorted.remap;
  if (yaml.baseline_m == 0) return;
  sequence.right = list_as_many(folder / "right", sequence.left);
  sequence.calibration.baseline_m = yaml.baseline_m;
}

/// Rectifies a pair; returns T_left_rectified.
SE3 take_raw_cameras(const std::string& yaml_path, const CalibrationYaml& yaml,
                     const fs::path& folder, RecordedSequence& sequence) {
  require_plausible_camera(yaml_path, yaml.camera());
  require_plausible_camera(yaml_path, yaml.right->raw);
  if (fs::is_directory(folder / "depth"))
    throw FileError(yaml_path,
                    "describes a pair that is not rectified, which cannot be combined with "
                    "depth/");
  sequence.right = list_as_many(folder / "right", sequence.left);
  const Camera& right = yaml.right->raw.camera;
  require_size(sequence.right[0], read_image(sequence.right[0]).grey, right.width, right.height);
  try {
    RectifiedStereo stereo =
        rectify_stereo(yaml.camera(), yaml.right->raw, yaml.right->T_left_right);
    sequence.calibration.camera = stereo.camera;
    sequence.calibration.baseline_m = stereo.baseline_m;
    sequence.left_remap = stereo.left;
    sequence.right_remap = stereo.right;
    return stereo.T_left_rectified;
  } catch (const ArgumentError& error) {
    throw FileError(yaml_path, error.what());
  }
}

void take_depth(const CalibrationYaml& yaml, const fs::path& folder, RecordedSequence& sequence) {
  if (!fs::is_directory(folder / "depth")) return;
  sequence.depth = list_as_many(folder / "depth", sequence.left);
  sequence.depth_unit_m = yaml.depth.unit_m;
  sequence.calibration.depth = yaml.depth_camera();
  if (yaml.depth.fx > 0) return;
  // Registered depth shares the lens distortion of the image.
  sequence.calibration.depth->camera = sequence.calibration.camera;
  sequence.depth_remap = sequence.left_remap;
}

}  // namespace

bool is_image_folder(const std::string& folder) {
  return fs::exists(fs::path(folder) / "calibration.yaml");
}

std::unique_ptr<Dataset> open_image_folder(const std::string& folder) {
  const fs::path path(folder);
  const std::string yaml_path = (path / "calibration.yaml").string();
  CalibrationYaml yaml;
  read_calibration_yaml(yaml_path, yaml);
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "images";
  sequence.left = list_images(folder_of_images(path));
  if (auto note = fit_to_image(sequence.left[0], read_image(sequence.left[0]).grey, yaml))
    sequence.notes.push_back(*note);
  sequence.raw_camera = yaml.camera().camera;
  SE3 T_left_rectified;
  if (yaml.right)
    T_left_rectified = take_raw_cameras(yaml_path, yaml, path, sequence);
  else
    take_cameras(yaml_path, yaml, path, sequence);
  if (yaml.camera_height_m > 0) sequence.calibration.camera_height_m = yaml.camera_height_m;
  take_depth(yaml, path, sequence);
  if (fs::exists(path / "times.txt")) {
    sequence.stamps_ns = read_times((path / "times.txt").string());
    if (sequence.stamps_ns.size() != sequence.left.size()) {
      throw FileError((path / "times.txt").string(),
                      fmt::format("holds {} times, but there are {} images",
                                  sequence.stamps_ns.size(), sequence.left.size()));
    }
  } else {
    sequence.stamps_ns =
        synthetic_stamps_ns(sequence.left.size(), yaml.fps > 0 ? yaml.fps : kDefaultRateHz);
  }
  read_ground_truth(path / "poses.txt", T_left_rectified, sequence);
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
