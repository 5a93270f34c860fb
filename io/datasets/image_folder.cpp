#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/image_folder.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> list_as_many(const fs::path& folder, std::size_t count) {
  std::vector<std::string> images = list_images(folder.string());
  if (images.size() == count) return images;
  throw FileError(folder.string(),
                  fmt::format("holds {} images, but there are {} left ones", images.size(), count));
}

/// Where the images of the (left) eye are: in the folder itself, or in one of these inside it.
std::string folder_of_images(const fs::path& folder) {
  if (holds_images(folder.string())) return folder.string();
  for (const char* name : {"images", "image", "left", "rgb"})
    if (holds_images((folder / name).string())) return (folder / name).string();
  return folder.string();
}

void read_ground_truth(const fs::path& path, RecordedSequence& sequence) {
  if (!fs::exists(path)) return;
  Trajectory truth = read_frame_poses(path.string());
  if (truth.size() != sequence.left.size()) {
    throw FileError(path.string(), fmt::format("holds {} poses, but there are {} images",
                                               truth.size(), sequence.left.size()));
  }
  truth.has_times = true;
  for (std::size_t i = 0; i < truth.size(); ++i) truth.poses[i].stamp_ns = sequence.stamps_ns[i];
  sequence.ground_truth = std::move(truth);
}

}  // namespace

bool is_image_folder(const std::string& folder) {
  return fs::exists(fs::path(folder) / "calibration.yaml");
}

std::unique_ptr<Dataset> open_image_folder(const std::string& folder) {
  const fs::path path(folder);
  CalibrationYaml yaml;
  read_calibration_yaml((path / "calibration.yaml").string(), yaml);
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "images";
  sequence.left = list_images(folder_of_images(path));
  if (auto note = fit_to_image(sequence.left[0], read_image(sequence.left[0]).grey, yaml))
    sequence.notes.push_back(*note);
  sequence.raw_camera = yaml.camera();
  const UndistortedCamera undistorted =
      undistort_plausibly((path / "calibration.yaml").string(), sequence.raw_camera);
  sequence.calibration.camera = undistorted.camera;
  sequence.left_remap = undistorted.remap;
  if (yaml.camera_height_m > 0) sequence.calibration.camera_height_m = yaml.camera_height_m;
  if (yaml.baseline_m > 0) {
    sequence.right = list_as_many(path / "right", sequence.left.size());
    sequence.calibration.baseline_m = yaml.baseline_m;
  }
  if (fs::is_directory(path / "depth")) {
    sequence.depth = list_as_many(path / "depth", sequence.left.size());
    sequence.depth_unit_m = yaml.depth.unit_m;
    sequence.calibration.depth = yaml.depth_camera();
    if (yaml.depth.fx == 0) {  // registered: it shares the lens distortion of the image
      sequence.calibration.depth->camera = undistorted.camera;
      sequence.depth_remap = undistorted.remap;
    }
  }
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
  read_ground_truth(path / "poses.txt", sequence);
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
