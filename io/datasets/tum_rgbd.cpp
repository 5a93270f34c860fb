#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/calibration_file.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/datasets/tum_rgbd.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

constexpr double kMaxDepthDelay_s = 0.02;
constexpr double kMaxTruthGap_s = 0.2;
constexpr double kDepthUnit_m = 1.0 / 5000;

struct ImageList {
  Trajectory stamps;  ///< without poses: what associate_by_time takes
  std::vector<std::string> paths;
};

/// "time filename" a line.
ImageList read_list(const fs::path& folder, const char* name) {
  TextFile file((folder / name).string());
  ImageList list;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 2) {
      file.fail(fmt::format("expected a time and a file name, found {} fields", fields.size()));
    }
    const std::int64_t stamp_ns = file.seconds_as_ns(fields[0], "time");
    if (list.stamps.size() > 0 && stamp_ns <= list.stamps.poses.back().stamp_ns) {
      file.fail("time " + in_quotes(fields[0]) + " does not increase");
    }
    list.stamps.poses.push_back({stamp_ns, std::nullopt});
    list.paths.push_back((folder / fields[1]).string());
  }
  if (list.paths.empty()) throw FileError(file.path(), "holds no images");
  return list;
}

/// The benchmark's own calibration (its documentation, "Calibration of the color camera").
std::optional<Camera> benchmark_camera(const std::string& name) {
  const auto is = [&name](const char* number) {
    return name.find(std::string("freiburg") + number) != name.npos ||
           name.find(std::string("fr") + number) != name.npos;
  };
  const Distortion model = Distortion::kRadialTangential;
  if (is("1")) {
    return Camera{
        640,        480,        517.306408, 516.469215,
        318.643040, 255.313989, model,      {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};
  }
  if (is("2")) {
    return Camera{
        640,        480,        520.908620, 521.007327,
        325.141442, 249.701764, model,      {0.231222, -0.784899, -0.003257, -0.000105, 0.917205}};
  }
  if (is("3")) return Camera{640, 480, 535.4, 539.2, 320.1, 247.6, Distortion::kNone, {}};
  return std::nullopt;
}

struct RgbdCameras {
  Camera raw;
  DepthCamera depth;
  bool registered = true;
  double depth_unit_m = kDepthUnit_m;
  std::optional<double> camera_height_m;
};

RgbdCameras read_cameras(const fs::path& folder, const std::string& name) {
  RgbdCameras cameras;
  const fs::path path = folder / "calibration.yaml";
  if (fs::exists(path)) {
    CalibrationYaml yaml;
    yaml.depth.unit_m = kDepthUnit_m;
    read_calibration_yaml(path.string(), yaml);
    if (yaml.baseline_m > 0) {
      throw FileError(path.string(), "baseline_m: a TUM sequence has one eye");
    }
    cameras.raw = yaml.camera();
    cameras.depth = yaml.depth_camera();
    cameras.registered = yaml.depth.fx == 0;
    cameras.depth_unit_m = yaml.depth.unit_m;
    if (yaml.camera_height_m > 0) cameras.camera_height_m = yaml.camera_height_m;
    return cameras;
  }
  const auto camera = benchmark_camera(name);
  if (!camera) {
    throw FileError(folder.string(),
                    "the intrinsics are unknown: the folder's name has no freiburg1, freiburg2 or "
                    "freiburg3, and there is no calibration.yaml in it");
  }
  cameras.raw = cameras.depth.camera = *camera;
  return cameras;
}

void take_images(const ImageList& colour, const ImageList* depth, RecordedSequence& sequence) {
  if (depth == nullptr) {
    for (const StampedPose& stamp : colour.stamps.poses)
      sequence.stamps_ns.push_back(stamp.stamp_ns);
    sequence.left = colour.paths;
    return;
  }
  AssociationOptions options;
  options.max_difference_s = kMaxDepthDelay_s;
  for (const auto& [c, d] : associate_by_time(colour.stamps, depth->stamps, options)) {
    const auto i = static_cast<std::size_t>(c);
    sequence.stamps_ns.push_back(colour.stamps.poses[i].stamp_ns);
    sequence.left.push_back(colour.paths[i]);
    sequence.depth.push_back(depth->paths[static_cast<std::size_t>(d)]);
  }
}

}  // namespace

bool is_tum_rgbd(const std::string& folder) { return fs::exists(fs::path(folder) / "rgb.txt"); }

std::unique_ptr<Dataset> open_tum_rgbd(const std::string& folder) {
  const fs::path path(folder);
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "tum";
  const RgbdCameras cameras = read_cameras(path, sequence.name);

  const ImageList colour = read_list(path, "rgb.txt");
  const bool has_depth = fs::exists(path / "depth.txt");
  const ImageList depth = has_depth ? read_list(path, "depth.txt") : ImageList{};
  take_images(colour, has_depth ? &depth : nullptr, sequence);
  if (sequence.left.empty()) {
    throw FileError((path / "depth.txt").string(),
                    "no depth image lies within 20 ms of any image of rgb.txt");
  }
  require_size(sequence.left[0], read_image(sequence.left[0]).grey, cameras.raw.width,
               cameras.raw.height);

  const UndistortedCamera undistorted = undistort_camera(cameras.raw);
  sequence.raw_camera = cameras.raw;
  sequence.calibration.camera = undistorted.camera;
  sequence.calibration.camera_height_m = cameras.camera_height_m;
  sequence.left_remap = undistorted.remap;
  if (has_depth) {
    sequence.calibration.depth = cameras.depth;
    sequence.depth_unit_m = cameras.depth_unit_m;
    if (cameras.registered) {  // it shares the lens distortion of the image it is registered to
      sequence.calibration.depth->camera = undistorted.camera;
      sequence.depth_remap = undistorted.remap;
    }
  }
  if (fs::exists(path / "groundtruth.txt")) {
    const std::string truth = (path / "groundtruth.txt").string();
    if (detect_trajectory_format(truth) != TrajectoryFormat::kTum) {
      throw FileError(truth, "is not in TUM form (t tx ty tz qx qy qz qw)");
    }
    sequence.ground_truth = resample(read_trajectory(truth), sequence.stamps_ns, kMaxTruthGap_s);
  }
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
