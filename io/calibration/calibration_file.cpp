#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/config/yaml_config.h>

#include <algorithm>
#include <filesystem>

namespace placegraph {
namespace {

constexpr const char* kUnrectified =
    "baseline_m: a folder of stereo images must be rectified, without distortion; use "
    "Kalibr's camchain or OpenCV's K1 D1 K2 D2 R T for an unrectified pair";

struct DistortionYaml {
  Distortion& model;
  std::vector<double>& coefficients;
};

void visit(OptionVisitor& field, DistortionYaml& yaml) {
  field.choice("model", yaml.model, {"none", "radial_tangential", "equidistant"},
               "distortion model");
  field("coefficients", yaml.coefficients,
        "k1 k2 p1 p2 [k3 [k4 k5 k6]] (radial_tangential) or k1 k2 k3 k4 (equidistant)",
        {-1e3, 1e3});
}

void check(const std::string& path, const CalibrationYaml& yaml) {
  const auto need = [&path](bool good, const char* message) {
    if (!good) throw FileError(path, message);
  };
  need(yaml.width > 0 && yaml.height > 0, "width, height: are missing");
  need(yaml.fx > 0 && yaml.fy > 0, "fx, fy: are missing");
  need(yaml.cx != 0 && yaml.cy != 0, "cx, cy: are missing");
  const std::size_t n = yaml.coefficients.size();
  switch (yaml.distortion) {
    case Distortion::kNone:
      need(std::ranges::all_of(yaml.coefficients, [](double k) { return k == 0; }),
           "distortion.coefficients: given, but distortion.model is none");
      break;
    case Distortion::kRadialTangential:
      try {
        RawCamera raw;
        set_radial_tangential(yaml.coefficients, raw);
      } catch (const ArgumentError& error) {
        need(false, (std::string("distortion.coefficients: ") + error.what()).c_str());
      }
      break;
    case Distortion::kEquidistant:
      need(n == 4, "distortion.coefficients: equidistant has 4");
      break;
  }
  need(yaml.baseline_m == 0 || yaml.distortion == Distortion::kNone, kUnrectified);
  const DepthYaml& depth = yaml.depth;
  need(depth.T_cam_depth.empty() || depth.T_cam_depth.size() == 12,
       "depth.T_cam_depth: expected 12 numbers");
  const bool own = depth.fx > 0;
  need(own == (depth.fy > 0) && own == (depth.width > 0) && own == (depth.height > 0),
       "depth: width, height, fx, fy, cx, cy go together");
  need(depth.sigma_at_1m > 0, "depth.sigma_at_1m: is not above 0");
  need(own || depth.T_cam_depth.empty(), "depth.T_cam_depth: needs a depth camera of its own (fx)");
}

}  // namespace

RawCamera CalibrationYaml::camera() const {
  RawCamera raw(Camera{width, height, fx, fy, cx, cy, distortion, {}});
  if (distortion == Distortion::kRadialTangential)
    set_radial_tangential(coefficients, raw);
  else
    std::copy_n(coefficients.begin(), std::min<std::size_t>(coefficients.size(), 5),
                raw.camera.coefficients.begin());
  return raw;
}

DepthCamera CalibrationYaml::depth_camera() const {
  DepthCamera result;
  result.sigma_at_1m = depth.sigma_at_1m;
  result.camera = camera().camera;
  if (depth.fx > 0) {
    result.camera = {depth.width, depth.height, depth.fx,          depth.fy,
                     depth.cx,    depth.cy,     Distortion::kNone, {}};
  }
  if (depth.T_cam_depth.size() == 12) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> T(depth.T_cam_depth.data());
    result.T_cam_depth = SE3(Eigen::Matrix3d(T.leftCols<3>()), T.col(3));
  }
  return result;
}

void visit(OptionVisitor& field, DepthYaml& yaml) {
  field("unit_m", yaml.unit_m, "depth per step of the 16-bit depth images [m]", {1e-6, 1});
  field("width", yaml.width, "width of the depth images [px]", {0, 20000});
  field("height", yaml.height, "height of the depth images [px]", {0, 20000});
  field("fx", yaml.fx, "focal length [px]; absent: depth is registered to the image", {0, 1e5});
  field("fy", yaml.fy, "focal length [px]", {0, 1e5});
  field("cx", yaml.cx, "principal point [px]", {-1e5, 1e5});
  field("cy", yaml.cy, "principal point [px]", {-1e5, 1e5});
  field("T_cam_depth", yaml.T_cam_depth,
        "pose of the depth camera in the camera, row-major 3x4 [m]", {-1e3, 1e3});
  field("sigma_at_1m", yaml.sigma_at_1m, "standard deviation of depth at 1 m [m]", {0, 1});
}

void visit(OptionVisitor& field, CalibrationYaml& yaml) {
  field("width", yaml.width, "width of the images [px]", {0, 20000});
  field("height", yaml.height, "height of the images [px]", {0, 20000});
  field("fx", yaml.fx, "focal length [px]", {0, 1e5});
  field("fy", yaml.fy, "focal length [px]", {0, 1e5});
  field("cx", yaml.cx, "principal point [px], from the centre of the top left pixel", {-1e5, 1e5});
  field("cy", yaml.cy, "principal point [px]", {-1e5, 1e5});
  DistortionYaml distortion{yaml.distortion, yaml.coefficients};
  field.group("distortion", distortion, "lens distortion of the raw images");
  field("baseline_m", yaml.baseline_m,
        "baseline to the right camera, whose images are in right/ [m]", {0, 100});
  field("camera_height_m", yaml.camera_height_m, "camera height above the ground [m]", {0, 1e4});
  field("fps", yaml.fps, "frame rate if there is no times.txt [Hz]", {0, 1e5});
  field.group("depth", yaml.depth, "depth images in depth/");
}

namespace {

/// The baseline is used only with images in right/; files of this format also give one for RGB-D
/// cameras.
void take(const ForeignCalibration& foreign, bool has_right, CalibrationYaml& yaml) {
  const Camera& camera = foreign.raw.camera;
  yaml.width = camera.width, yaml.height = camera.height;
  yaml.fx = camera.fx, yaml.fy = camera.fy, yaml.cx = camera.cx, yaml.cy = camera.cy;
  yaml.distortion = camera.distortion;
  if (camera.distortion != Distortion::kNone) yaml.coefficients = foreign.raw.coefficients();
  yaml.right = foreign.right;
  if (has_right) yaml.baseline_m = foreign.baseline_m;
  if (foreign.fps > 0) yaml.fps = foreign.fps;
  if (foreign.depth_unit_m > 0) yaml.depth.unit_m = foreign.depth_unit_m;
}

}  // namespace

void read_calibration_yaml(const std::string& path, CalibrationYaml& yaml) {
  const auto folder = std::filesystem::path(path).parent_path();
  const bool has_right = std::filesystem::is_directory(folder / "right");
  if (const auto foreign = read_foreign_calibration(path, has_right)) {
    take(*foreign, has_right, yaml);
    if (yaml.baseline_m > 0 && yaml.distortion != Distortion::kNone)
      throw FileError(path, kUnrectified);
    return;
  }
  read_options(path, yaml);
  check(path, yaml);
  try {
    yaml.camera().check();
    yaml.depth_camera().camera.check();
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
}

}  // namespace placegraph
