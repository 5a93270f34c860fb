#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/defects/defects.h>
#include <placegraph/io/synthetic/render/sensor_model.h>

namespace placegraph {

namespace synthetic {

Difficulty difficulty_from(const std::string& name) {
  for (const Difficulty d : {Difficulty::kClean, Difficulty::kStandard, Difficulty::kHard}) {
    if (name == to_string(d)) return d;
  }
  throw ArgumentError("difficulty: '" + name + "' is none of clean, standard, hard");
}

const char* to_string(Difficulty difficulty) {
  static constexpr const char* kNames[] = {"clean", "standard", "hard"};
  return kNames[static_cast<int>(difficulty)];
}

SensorModel sensor_model(Difficulty difficulty) {
  switch (difficulty) {
    case Difficulty::kClean:
      return {};
    case Difficulty::kStandard:
      return {.noise_grey = 2, .exposure = 0.05, .shutter_s = 0.006, .contrast = 1, .traffic = 6};
    case Difficulty::kHard:
      break;
  }
  return {.noise_grey = 5, .exposure = 0.20, .shutter_s = 0.012, .contrast = 0.6, .traffic = 14};
}

}  // namespace synthetic

void visit(OptionVisitor& field, SyntheticDefects& d) {
  field("calibration_error", d.calibration_error,
        "relative error of the written calibration, sigma", {0, 0.05});
  field("time_jitter_s", d.time_jitter_s, "error of the written times [s], sigma", {0, 0.02});
  field("rolling_shutter_s", d.rolling_shutter_s,
        "time from the first to the last row of an image [s], centred on its time", {0, 0.05});
  field("undulation_m", d.undulation_m, "undulation of the road [m], root mean square", {0, 0.2});
  field("shutter_s", d.shutter_s, "exposure time [s]; 0 = that of the difficulty", {0, 0.1});
  field("depth_lag_s", d.depth_lag_s, "time by which depth is older than its image [s]",
        {-0.2, 0.2});
  field("depth_quantization", d.depth_quantization,
        "step of inverse depth [1/m]; 0.00285 for structured light", {0, 0.1});
  field("depth_noise", d.depth_noise, "noise of inverse depth [1/m], sigma", {0, 0.1});
  field("depth_holes", d.depth_holes, "share of the pixels without a depth", {0, 0.9});
  field("flying_pixels", d.flying_pixels,
        "share of the pixels within 2 px of a depth edge whose depth lies between its sides",
        {0, 1});
  field("depth_scale_error", d.depth_scale_error, "relative error of the scale of depth, sigma",
        {0, 0.1});
}

namespace {

struct DefectSet {
  const char* name;
  SyntheticDefects defects;
};

const std::vector<DefectSet>& sets() {
  static const std::vector<DefectSet> list = [] {
    SyntheticDefects drive, rgbd;
    drive.calibration_error = 0.005;
    drive.time_jitter_s = 0.001;
    drive.rolling_shutter_s = 0.015;
    drive.undulation_m = 0.02;
    rgbd.calibration_error = 0.005;
    rgbd.shutter_s = 0.015;
    rgbd.depth_lag_s = 0.02;
    rgbd.depth_quantization = 0.00285;
    rgbd.depth_noise = 0.0014;
    rgbd.depth_holes = 0.1;
    rgbd.flying_pixels = 0.5;
    rgbd.depth_scale_error = 0.005;
    return std::vector<DefectSet>{{"none", {}}, {"hard-drive", drive}, {"hard-rgbd", rgbd}};
  }();
  return list;
}

}  // namespace

const std::vector<std::string>& defect_sets() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const DefectSet& set : sets()) out.emplace_back(set.name);
    return out;
  }();
  return names;
}

SyntheticDefects defects_from(const std::string& name) {
  std::string names;
  for (const DefectSet& set : sets()) {
    if (name == set.name) return set.defects;
    names += std::string(names.empty() ? "" : ", ") + set.name;
  }
  throw ArgumentError("defects: '" + name + "' is none of " + names);
}

bool has_depth_defects(const SyntheticDefects& d) {
  return d.depth_lag_s != 0 || d.depth_quantization != 0 || d.depth_noise != 0 ||
         d.depth_holes != 0 || d.flying_pixels != 0 || d.depth_scale_error != 0;
}

std::string defect_list(const SyntheticDefects& defects) {
  std::string text;
  for (const OptionEntry& entry : list_options(defects))
    if (entry.value != "0") text += fmt::format("  {}: {}\n", entry.path, entry.value);
  return text;
}

namespace synthetic {
namespace {

void miscalibrate(Camera& camera, double error, Random& random) {
  const double shift_px = error * camera.fx, factor = 1 + random.normal(0, error);
  camera.fx *= factor;
  camera.fy *= factor;
  camera.cx += random.normal(0, shift_px);
  camera.cy += random.normal(0, shift_px);
}

}  // namespace

Calibration miscalibrated(Calibration calibration, double error, std::uint64_t seed) {
  if (error == 0) return calibration;
  Random random(seed, 61);
  miscalibrate(calibration.camera, error, random);
  calibration.baseline_m *= 1 + random.normal(0, error);
  const double height_factor = 1 + random.normal(0, error);
  if (calibration.camera_height_m) *calibration.camera_height_m *= height_factor;
  if (calibration.depth) miscalibrate(calibration.depth->camera, error, random);
  return calibration;
}

}  // namespace synthetic
}  // namespace placegraph
