#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/datasets/tum_rgbd.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cctype>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

// That of TUM's associate.py, 0.02 s; 0.2 s without truth (docs/datasets.md); TUM's depth unit.
constexpr double kMaxDepthDelay_s = 0.02;
constexpr double kMaxTruthGap_s = 0.2;
constexpr double kDepthUnit_m = 1.0 / 5000;

struct ImageList {
  Trajectory stamps;  ///< without poses: input of associate_by_time
  std::vector<std::string> paths;
};

/// Reads lines "time filename".
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

constexpr const char* kAssociations[] = {"associations.txt", "association.txt", "associated.txt",
                                         "associate.txt"};

/// The file of pairs that replaces rgb.txt and depth.txt; empty if there is none.
fs::path associations_of(const fs::path& folder) {
  for (const char* name : kAssociations)
    if (fs::exists(folder / name)) return folder / name;
  return {};
}

/// Reads lines "time image time depth_image", as the benchmark's script writes them, or with depth
/// first, recognized by the folder's name. The times of the images are used.
void read_associations(const fs::path& path, RecordedSequence& sequence) {
  TextFile file(path.string());
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 4)
      file.fail(fmt::format("expected time, image, time and depth image, found {} fields",
                            fields.size()));
    const bool depth_first = fields[1].find("depth") != fields[1].npos;
    const std::size_t colour = depth_first ? 2 : 0, depth = depth_first ? 0 : 2;
    const std::int64_t stamp_ns = file.seconds_as_ns(fields[colour], "time");
    if (!sequence.stamps_ns.empty() && stamp_ns <= sequence.stamps_ns.back())
      file.fail("time " + in_quotes(fields[colour]) + " does not increase");
    sequence.stamps_ns.push_back(stamp_ns);
    sequence.left.push_back((path.parent_path() / fields[colour + 1]).string());
    sequence.depth.push_back((path.parent_path() / fields[depth + 1]).string());
  }
  if (sequence.left.empty()) throw FileError(path.string(), "holds no images");
}

/// Whether a name contains a word that has neither letters nor digits before it and no digits after
/// it, as in the benchmark's "rgbd_dataset_freiburg1_xyz".
bool has_word(const std::string& name, const std::string& word) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = name.find(word); at != name.npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || (!is_digit(name[at - 1]) && !is_letter(name[at - 1]));
    if (begins && (end == name.size() || !is_digit(name[end]))) return true;
  }
  return false;
}

/// The benchmark's own calibration (its documentation, "Calibration of the color camera").
std::optional<Camera> benchmark_camera(const std::string& name) {
  const auto is = [&name](const std::string& number) {
    return has_word(name, "freiburg" + number) ||
           (name.starts_with("fr" + number) && has_word(name, "fr" + number));
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

/// Camera of ICL-NUIM (Handa et al. 2014). Its own calibration has a negative fy, because its axis
/// y points up; instead, the ground truth is flipped.
constexpr Camera kIclNuim{640, 480, 481.20, 480.00, 319.5, 239.5, Distortion::kNone, {}};

/// The ground truth of ICL-NUIM in TUM's format, "livingRoom0.gt.freiburg"; empty in other folders.
fs::path icl_nuim_truth(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().filename().string().ends_with(".gt.freiburg")) return entry.path();
  return {};
}

/// Whether times are frame numbers (0, 1, 2, ...) at 30 Hz, as in ICL-NUIM.
bool are_frame_numbers(const std::vector<std::int64_t>& stamps_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i)
    if (stamps_ns[i] != stamps_ns[i - 1] + kSecond_ns) return false;
  return stamps_ns.size() > 1 && (stamps_ns[0] == 0 || stamps_ns[0] == kSecond_ns);
}

constexpr std::int64_t kIclNuimRate_Hz = 30;

/// Reads poses with frame numbers as times, and converts them to y down.
Trajectory read_icl_nuim_truth(const fs::path& path) {
  Trajectory truth = read_timed_poses(path.string());
  const Eigen::Vector3d flip(1, -1, 1);
  for (StampedPose& pose : truth.poses) {
    pose.stamp_ns /= kIclNuimRate_Hz;
    if (pose.T_world_body)
      pose.T_world_body->matrix().topLeftCorner<3, 4>() =
          flip.asDiagonal() * pose.T_world_body->matrix().topLeftCorner<3, 4>() *
          Eigen::Vector4d(1, -1, 1, 1).asDiagonal();
  }
  return truth;
}

/// The calibration of calibration.yaml, else the benchmark's, selected by the folder's name.
CalibrationYaml read_calibration(const fs::path& folder, const std::string& name) {
  CalibrationYaml yaml;
  yaml.depth.unit_m = kDepthUnit_m;
  const fs::path path = folder / "calibration.yaml";
  if (fs::exists(path)) {
    read_calibration_yaml(path.string(), yaml);
    if (yaml.baseline_m > 0)
      throw FileError(path.string(), "baseline_m: a TUM sequence has one camera");
    return yaml;
  }
  const auto camera = icl_nuim_truth(folder).empty() ? benchmark_camera(name) : kIclNuim;
  if (!camera) {
    throw FileError(folder.string(),
                    "the intrinsics are unknown: the folder's name has no freiburg1, freiburg2 or "
                    "freiburg3, and there is no calibration.yaml in it");
  }
  yaml.width = camera->width, yaml.height = camera->height;
  yaml.fx = camera->fx, yaml.fy = camera->fy, yaml.cx = camera->cx, yaml.cy = camera->cy;
  yaml.distortion = camera->distortion;
  yaml.coefficients.assign(camera->coefficients.begin(), camera->coefficients.end());
  return yaml;
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
  const std::size_t pairs = sequence.left.size();
  if (pairs < colour.paths.size())
    sequence.notes.push_back({fmt::format(
        "{} of {} images are skipped: no depth image within {:g} ms (depth.txt has {})",
        colour.paths.size() - pairs, colour.paths.size(), 1e3 * kMaxDepthDelay_s,
        depth->paths.size())});
}

}  // namespace

bool is_tum_rgbd(const std::string& folder) {
  return fs::exists(fs::path(folder) / "rgb.txt") || !associations_of(folder).empty();
}

std::unique_ptr<Dataset> open_tum_rgbd(const std::string& folder) {
  const fs::path path(folder);
  RecordedSequence sequence;
  sequence.name = folder_name(folder);
  sequence.format = "tum";
  CalibrationYaml yaml = read_calibration(path, sequence.name);

  bool has_depth = true;
  if (fs::exists(path / "rgb.txt")) {
    const ImageList colour = read_list(path, "rgb.txt");
    has_depth = fs::exists(path / "depth.txt");
    const ImageList depth = has_depth ? read_list(path, "depth.txt") : ImageList{};
    take_images(colour, has_depth ? &depth : nullptr, sequence);
    if (!has_depth && fs::is_directory(path / "depth"))
      sequence.notes.push_back(
          {"depth.txt is missing, so that depth/ is not used: the sequence is run as monocular"});
  } else {
    read_associations(associations_of(path), sequence);
  }
  if (sequence.left.empty()) {
    throw FileError((path / "depth.txt").string(),
                    "no depth image is within 20 ms of any image of rgb.txt");
  }
  if (auto note = fit_to_image(sequence.left[0], read_image(sequence.left[0]).grey, yaml))
    sequence.notes.push_back(*note);

  const UndistortedCamera undistorted =
      undistort_plausibly((path / "calibration.yaml").string(), yaml.camera());
  sequence.raw_camera = yaml.camera().camera;
  sequence.calibration.camera = undistorted.camera;
  if (yaml.camera_height_m > 0) sequence.calibration.camera_height_m = yaml.camera_height_m;
  sequence.left_remap = undistorted.remap;
  if (has_depth) {
    sequence.calibration.depth = yaml.depth_camera();
    sequence.depth_unit_m = yaml.depth.unit_m;
    if (yaml.depth.fx == 0) {  // it shares the lens distortion of the image it is registered to
      sequence.calibration.depth->camera = undistorted.camera;
      sequence.depth_remap = undistorted.remap;
    }
  }
  if (const fs::path truth = icl_nuim_truth(path); !truth.empty()) {
    if (are_frame_numbers(sequence.stamps_ns))
      for (std::int64_t& stamp_ns : sequence.stamps_ns) stamp_ns /= kIclNuimRate_Hz;
    sequence.ground_truth =
        resample(read_icl_nuim_truth(truth), sequence.stamps_ns, kMaxTruthGap_s);
  } else if (fs::exists(path / "groundtruth.txt")) {
    const std::string truth = (path / "groundtruth.txt").string();
    sequence.ground_truth = resample(read_timed_poses(truth), sequence.stamps_ns, kMaxTruthGap_s);
  }
  return make_dataset(std::move(sequence));
}

}  // namespace placegraph
