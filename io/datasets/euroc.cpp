#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/datasets/euroc.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/sensors/euroc_sensor.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

// 0.2 s (docs/datasets.md). Chosen.
constexpr double kMaxTruthGap_s = 0.2;

fs::path mav_folder(const std::string& folder) {
  const fs::path nested = fs::path(folder) / "mav0";
  return fs::is_directory(nested) ? nested : fs::path(folder);
}

struct ImageList {
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string> paths;
};

/// Lists a camera's folder without data.csv: the names of the images are their stamps [ns].
ImageList list_of_names(const fs::path& camera_folder) {
  const std::string missing = (camera_folder / "data.csv").string(),
                    folder = (camera_folder / "data").string();
  if (!fs::is_directory(folder)) {
    const std::string around = images_around(camera_folder.string());
    throw FileError(missing, "is missing" + (around.empty() ? "" : "; there are " + around));
  }
  ImageList list;
  for (const std::string& path : list_images(folder)) {
    const std::string stem = fs::path(path).stem().string();
    const std::optional<std::int64_t> stamp_ns = parse_integer(stem);
    if (!stamp_ns)
      throw FileError(missing, "is missing, and " + path +
                                   " is not named by its time [ns]; there are " +
                                   images_around(camera_folder.string()));
    list.stamps_ns.push_back(*stamp_ns);
    list.paths.push_back(path);
  }
  return list;
}

bool has_images(const fs::path& camera_folder) {
  return fs::exists(camera_folder / "data.csv") || fs::is_directory(camera_folder / "data");
}

/// Reads lines "timestamp [ns],filename".
ImageList read_list(const fs::path& camera_folder) {
  if (!fs::exists(camera_folder / "data.csv")) return list_of_names(camera_folder);
  TextFile file((camera_folder / "data.csv").string());
  ImageList list;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_comma(line, fields);
    if (fields.size() != 2 || fields[1].empty()) {
      file.fail(fmt::format("expected t_ns,filename, found {} columns", fields.size()));
    }
    const std::int64_t stamp_ns = file.integer(fields[0], "time [ns]");
    if (!list.stamps_ns.empty() && stamp_ns <= list.stamps_ns.back()) {
      file.fail(fmt::format("time {} ns does not increase", stamp_ns));
    }
    list.stamps_ns.push_back(stamp_ns);
    list.paths.push_back((camera_folder / "data" / fields[1]).string());
  }
  if (list.paths.empty()) throw FileError(file.path(), "holds no images");
  return list;
}

struct BodyCamera {
  Camera camera;
  SE3 T_body_cam;
};

BodyCamera read_sensor(const fs::path& camera_folder) {
  const YamlDocument yaml((camera_folder / "sensor.yaml").string());
  const YAML::Node& root = yaml.root();
  if (!root.IsMap()) yaml.fail(root, "is not the sensor.yaml of a camera");
  BodyCamera result;
  if (yaml.text(root, "camera_model") != "pinhole") {
    yaml.fail(root["camera_model"], "camera_model: only pinhole is supported");
  }
  Camera& camera = result.camera;
  const std::vector<double> size = yaml.numbers(root, "resolution", 2);
  const std::vector<double> k = yaml.numbers(root, "intrinsics", 4);
  if (!(size[0] >= 1 && size[0] <= 20000 && size[1] >= 1 && size[1] <= 20000)) {
    yaml.fail(root["resolution"], "resolution: is not a size of 1 to 20000 px");
  }
  camera.width = static_cast<int>(size[0]), camera.height = static_cast<int>(size[1]);
  camera.fx = k[0], camera.fy = k[1], camera.cx = k[2], camera.cy = k[3];

  const std::string model = yaml.text(root, "distortion_model");
  const std::vector<double> d = yaml.numbers(root, "distortion_coefficients", 0);
  if (model == "radial-tangential" || model == "radtan" || model == "plumb_bob") {
    camera.distortion = Distortion::kRadialTangential;
  } else if (model == "equidistant" || model == "equi") {
    camera.distortion = Distortion::kEquidistant;
  } else if (model != "none") {
    yaml.fail(root["distortion_model"],
              "distortion_model: " + in_quotes(model) + " is not radial-tangential or equidistant");
  }
  const bool five = camera.distortion == Distortion::kRadialTangential && d.size() == 5;
  if (camera.distortion != Distortion::kNone && d.size() != 4 && !five) {
    yaml.fail(root["distortion_coefficients"],
              fmt::format("distortion_coefficients: expected 4, found {}", d.size()));
  }
  if (camera.distortion != Distortion::kNone)
    std::copy(d.begin(), d.end(), camera.coefficients.begin());
  try {
    camera.check();
  } catch (const ArgumentError& error) {
    yaml.fail(root["intrinsics"], error.what());
  }
  result.T_body_cam = read_T_body_sensor(yaml);
  return result;
}

Trajectory stamps_of(const ImageList& images) {
  Trajectory stamps;
  for (const std::int64_t stamp_ns : images.stamps_ns)
    stamps.poses.push_back({stamp_ns, std::nullopt});
  return stamps;
}

/// The cameras are triggered together: images more than a tenth of a frame apart are not a pair.
constexpr double kMaxPairShare = 0.1;

/// Pairs images by their nearest stamps; adds a note about skipped images.
void take_pairs(const ImageList& left, const ImageList& right, RecordedSequence& sequence) {
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < left.stamps_ns.size(); ++i)
    gaps_s.push_back(seconds(left.stamps_ns[i - 1], left.stamps_ns[i]));
  AssociationOptions nearest;
  nearest.max_difference_s = gaps_s.empty() ? 0 : kMaxPairShare * median_of(gaps_s);
  double apart_s = 0;
  for (const auto& [l, r] : associate_by_time(stamps_of(left), stamps_of(right), nearest)) {
    const auto i = static_cast<std::size_t>(l), j = static_cast<std::size_t>(r);
    sequence.stamps_ns.push_back(left.stamps_ns[i]);
    sequence.left.push_back(left.paths[i]);
    sequence.right.push_back(right.paths[j]);
    apart_s = std::max(apart_s, std::abs(seconds(left.stamps_ns[i], right.stamps_ns[j])));
  }
  const std::size_t pairs = sequence.left.size();
  if (pairs < left.paths.size() || pairs < right.paths.size())
    sequence.notes.push_back({fmt::format(
        "{} stereo pairs: {} of {} images of cam0 and {} of {} of cam1 are skipped, having no "
        "partner within {:.3g} ms",
        pairs, left.paths.size() - pairs, left.paths.size(), right.paths.size() - pairs,
        right.paths.size(), 1e3 * nearest.max_difference_s)});
  if (apart_s > 0)
    sequence.notes.push_back(
        {fmt::format("the stamps of the two cameras differ by up to {:.3g} ms", 1e3 * apart_s)});
}

/// Fills cameras and images; returns T_body_cam of the returned left camera.
SE3 read_mav_cameras(const fs::path& mav, RecordedSequence& sequence) {
  const ImageList left_images = read_list(mav / "cam0");
  const BodyCamera left = read_sensor(mav / "cam0");
  sequence.raw_camera = left.camera;
  require_size(left_images.paths[0], read_image(left_images.paths[0]).grey, left.camera.width,
               left.camera.height);
  if (!has_images(mav / "cam1")) {
    sequence.stamps_ns = left_images.stamps_ns;
    sequence.left = left_images.paths;
    const UndistortedCamera undistorted =
        undistort_plausibly((mav / "cam0" / "sensor.yaml").string(), left.camera);
    sequence.calibration.camera = undistorted.camera;
    sequence.left_remap = undistorted.remap;
    return left.T_body_cam;
  }
  const std::string right_list = (mav / "cam1" / "data.csv").string();
  take_pairs(left_images, read_list(mav / "cam1"), sequence);
  if (sequence.left.empty()) throw FileError(right_list, "has no stamp near one of cam0");
  const BodyCamera right = read_sensor(mav / "cam1");
  require_plausible_camera((mav / "cam0" / "sensor.yaml").string(), left.camera);
  require_plausible_camera((mav / "cam1" / "sensor.yaml").string(), right.camera);
  try {
    RectifiedStereo stereo =
        rectify_stereo(left.camera, right.camera, left.T_body_cam.inverse() * right.T_body_cam);
    sequence.calibration.camera = stereo.camera;
    sequence.calibration.baseline_m = stereo.baseline_m;
    sequence.left_remap = stereo.left;
    sequence.right_remap = stereo.right;
    return left.T_body_cam * stereo.T_left_rectified;
  } catch (const ArgumentError& error) {
    throw FileError((mav / "cam1" / "sensor.yaml").string(), error.what());
  }
}

}  // namespace

bool is_euroc(const std::string& folder) {
  const fs::path mav = mav_folder(folder);
  if (mav != fs::path(folder)) return fs::is_directory(mav / "cam0");
  return fs::exists(mav / "cam0" / "data.csv") || fs::exists(mav / "cam0" / "sensor.yaml");
}

std::unique_ptr<Dataset> open_euroc(const std::string& folder) {
  return open_euroc_body(folder).images;
}

EurocBody open_euroc_body(const std::string& folder) {
  const fs::path mav = mav_folder(folder);
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "euroc";
  const SE3 T_body_cam = read_mav_cameras(mav, sequence);

  const fs::path truth = mav / "state_groundtruth_estimate0" / "data.csv";
  if (fs::exists(truth)) {
    sequence.ground_truth =
        resample(read_timed_poses(truth.string()), sequence.stamps_ns, kMaxTruthGap_s);
    for (StampedPose& pose : sequence.ground_truth->poses) {
      if (pose.T_world_body) *pose.T_world_body = *pose.T_world_body * T_body_cam.isometry();
    }
  }
  return {make_dataset(std::move(sequence)), T_body_cam, mav.string()};
}

}  // namespace placegraph
