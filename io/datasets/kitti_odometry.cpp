#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/datasets/kitti_calibration.h>
#include <placegraph/io/datasets/kitti_odometry.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

void require_count(const std::string& path, std::size_t found, std::size_t images) {
  if (found == images) return;
  throw FileError(path,
                  fmt::format("holds {} entries, but there are {} left images", found, images));
}

/// Reads the left camera (image_0, else image_2) and, if calibrated, the right one (image_1 /
/// image_3). Returns the left camera's position in the frame of camera 0, to which ground truth
/// refers.
Eigen::Vector3d read_cameras(const fs::path& folder, RecordedSequence& sequence) {
  const int left = fs::is_directory(folder / "image_0") ? 0 : 2;
  const fs::path right_folder = folder / fmt::format("image_{}", left + 1);
  const KittiCameras cameras =
      read_kitti_cameras((folder / "calib.txt").string(), left, fs::is_directory(right_folder));
  sequence.left = list_numbered_images((folder / fmt::format("image_{}", left)).string());
  sequence.calibration.camera = cameras.camera;
  sequence.rectified = cameras.paired;
  set_size(sequence.left[0], read_image(sequence.left[0]).grey, sequence.calibration.camera);
  require_plausible_camera((folder / "calib.txt").string(), sequence.calibration.camera);
  sequence.raw_camera = sequence.calibration.camera;
  if (cameras.baseline_m > 0) {
    sequence.right = list_numbered_images(right_folder.string());
    require_count(right_folder.string(), sequence.right.size(), sequence.left.size());
    sequence.calibration.baseline_m = cameras.baseline_m;
  }
  return cameras.position_in_cam0;
}

/// Reads depth_0 with its own camera in calib_depth.txt; without that file it is registered to the
/// left camera.
void read_depth_camera(const fs::path& folder, RecordedSequence& sequence) {
  if (!fs::is_directory(folder / "depth_0")) return;
  sequence.depth = list_numbered_images((folder / "depth_0").string());
  require_count((folder / "depth_0").string(), sequence.depth.size(), sequence.left.size());
  DepthCamera depth;
  depth.camera = sequence.calibration.camera;
  const fs::path path = folder / "calib_depth.txt";
  const bool own = fs::exists(path);
  if (own) {
    const auto lines =
        read_kitti_lines(path.string(), {{"P0", 12}, {"T_cam_depth", 12}, {"unit_m", 1}});
    const auto P = lines.find("P0"), T = lines.find("T_cam_depth"), unit = lines.find("unit_m");
    if (P == lines.end()) throw FileError(path.string(), "has no line P0:");
    depth.camera = kitti_camera(path.string(), "P0", P->second);
    if (T != lines.end()) {
      Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix(T->second.numbers.data());
      try {
        depth.T_cam_depth = SE3(Eigen::Matrix3d(matrix.leftCols<3>()), matrix.col(3));
      } catch (const ArgumentError& error) {
        throw FileError(path.string(), T->second.line,
                        fmt::format("T_cam_depth: {}", error.what()));
      }
    }
    if (unit != lines.end()) {
      sequence.depth_unit_m = unit->second.numbers[0];
      if (!(sequence.depth_unit_m > 0)) {
        throw FileError(path.string(), unit->second.line, "unit_m: must be positive");
      }
    }
  }
  const Image first = read_depth(sequence.depth[0], sequence.depth_unit_m);
  if (own) {
    set_size(sequence.depth[0], first, depth.camera);
  } else {
    require_size(sequence.depth[0], first, depth.camera.width, depth.camera.height);
  }
  sequence.calibration.depth = depth;
}

/// Reads world.yaml of rendered sequences, which contains what KITTI's files cannot express.
void read_world(const fs::path& folder, RecordedSequence& sequence) {
  const std::string path = (folder / "world.yaml").string();
  if (!fs::exists(path)) return;
  const YamlDocument document(path);
  const auto height = document.optional_number(document.root(), "camera_height_m");
  if (height) {
    if (!(*height > 0)) {
      document.fail(document.root()["camera_height_m"], "camera_height_m: must be positive");
    }
    sequence.calibration.camera_height_m = *height;
  }
}

void read_ground_truth(const fs::path& folder, const Eigen::Vector3d& position_in_cam0,
                       RecordedSequence& sequence) {
  fs::path path = folder / "poses.txt";
  const fs::path normal = fs::absolute(folder / "").lexically_normal().parent_path();
  if (!fs::exists(path) && normal.parent_path().filename() == "sequences") {
    path = normal.parent_path().parent_path() / "poses" / (normal.filename().string() + ".txt");
  }
  if (!fs::exists(path)) return;
  Trajectory truth = read_frame_poses(path.string());
  require_count(path.string(), truth.size(), sequence.left.size());
  truth.has_times = true;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    StampedPose& pose = truth.poses[i];
    pose.stamp_ns = sequence.stamps_ns[i];
    if (pose.T_world_body) pose.T_world_body->translate(position_in_cam0);
  }
  sequence.ground_truth = std::move(truth);
}

}  // namespace

bool is_kitti_odometry(const std::string& folder) {
  const fs::path path(folder);
  return fs::exists(path / "calib.txt") &&
         (fs::is_directory(path / "image_0") || fs::is_directory(path / "image_2"));
}

std::unique_ptr<Dataset> open_kitti_odometry(const std::string& folder) {
  const fs::path path(folder);
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "kitti";
  const Eigen::Vector3d position_in_cam0 = read_cameras(path, sequence);
  read_depth_camera(path, sequence);
  if (fs::exists(path / "times.txt")) {
    sequence.stamps_ns = read_times((path / "times.txt").string());
    require_count((path / "times.txt").string(), sequence.stamps_ns.size(), sequence.left.size());
  } else {
    sequence.stamps_ns = synthetic_stamps_ns(sequence.left.size());
  }
  read_world(path, sequence);
  read_ground_truth(path, position_in_cam0, sequence);
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
