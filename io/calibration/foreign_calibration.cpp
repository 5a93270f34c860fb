#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_reader.h>
#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/calibration/kalibr_calibration.h>
#include <placegraph/io/calibration/opencv_calibration.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <cctype>

namespace placegraph {
namespace {

/// `prefix`: "Camera." or, since ORB-SLAM's third version, "Camera1.".
ForeignCalibration read_orb_slam(const YamlDocument& yaml, const std::string& prefix) {
  const YAML::Node& root = yaml.root();
  const CalibrationReader reader(yaml, "ORB-SLAM");
  ForeignCalibration result;
  result.program = "ORB-SLAM";
  Camera& camera = result.raw.camera;
  camera.fx = reader.number(root, prefix + "fx"), camera.fy = reader.number(root, prefix + "fy");
  camera.cx = reader.number(root, prefix + "cx"), camera.cy = reader.number(root, prefix + "cy");
  camera.width = reader.side(reader.number_or_zero(root, "Camera.width"), root);
  camera.height = reader.side(reader.number_or_zero(root, "Camera.height"), root);
  result.fps = reader.number_or_zero(root, "Camera.fps");
  if (root["Camera.bf"].IsDefined())
    result.baseline_m = reader.number(root, "Camera.bf") / camera.fx;
  if (root["Stereo.b"].IsDefined()) result.baseline_m = reader.number(root, "Stereo.b");
  for (const char* key : {"DepthMapFactor", "RGBD.DepthMapFactor"})
    if (root[key].IsDefined() && reader.number(root, key) > 0)
      result.depth_unit_m = 1 / reader.number(root, key);
  const std::string type =
      root["Camera.type"].IsDefined() ? lower(root["Camera.type"].Scalar()) : "";
  std::vector<double> d;
  const bool fisheye = type == "kannalabrandt8";
  const auto names = fisheye ? std::vector<const char*>{"k1", "k2", "k3", "k4"}
                             : std::vector<const char*>{"k1", "k2", "p1", "p2", "k3"};
  for (const char* name : names) d.push_back(reader.number_or_zero(root, prefix + name));
  reader.set_distortion(fisheye ? "equidistant" : "radtan", d, root, result.raw);
  return result;
}

ForeignCalibration read_realsense(const YamlDocument& yaml, const YAML::Node& camera_node) {
  const CalibrationReader reader(yaml, "RealSense");
  ForeignCalibration result;
  result.program = "RealSense";
  Camera& camera = result.raw.camera;
  camera.fx = reader.number(camera_node, "fx"), camera.fy = reader.number(camera_node, "fy");
  camera.cx = reader.number(camera_node, "ppx"), camera.cy = reader.number(camera_node, "ppy");
  camera.width = reader.side(reader.number_or_zero(camera_node, "width"), camera_node);
  camera.height = reader.side(reader.number_or_zero(camera_node, "height"), camera_node);
  if (camera_node["coeffs"].IsDefined()) {
    std::string model =
        camera_node["model"].IsDefined() ? lower(camera_node["model"].Scalar()) : "";
    if (const std::size_t dot = model.rfind('.'); dot != model.npos) model.erase(0, dot + 1);
    std::replace(model.begin(), model.end(), ' ', '_');
    reader.set_distortion(model, reader.numbers(camera_node["coeffs"], "coeffs"),
                          camera_node["coeffs"], result.raw);
  }
  return result;
}

std::optional<ForeignCalibration> read_yaml(const std::string& path, bool with_right) {
  const YamlDocument yaml(path);
  const YAML::Node& root = yaml.root();
  if (!root.IsMap()) return std::nullopt;
  if (root["cam0"].IsDefined() && root["cam0"].IsMap()) return read_kalibr(yaml, with_right);
  for (const char* prefix : {"Camera.", "Camera1."})
    if (root[std::string(prefix) + "fx"].IsDefined()) return read_orb_slam(yaml, prefix);
  if (auto opencv = read_opencv_yaml(yaml, with_right)) return opencv;
  if (root["ppx"].IsDefined()) return read_realsense(yaml, root);
  for (const char* stream : {"color", "rgb", "left", "infrared"})
    if (root[stream].IsDefined() && root[stream].IsMap() && root[stream]["ppx"].IsDefined())
      return read_realsense(yaml, root[stream]);
  return std::nullopt;
}

/// Reads the first line "CAMERA_ID MODEL WIDTH HEIGHT PARAMS...". The centre of COLMAP's first
/// pixel is (0.5, 0.5).
std::optional<ForeignCalibration> read_colmap(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  if (!file.next_data(line)) return std::nullopt;
  split_blank(line, fields);
  if (fields.size() < 7 || !parse_integer(fields[0]) ||
      !std::isupper(static_cast<unsigned char>(fields[1][0])))
    return std::nullopt;
  ForeignCalibration result;
  result.program = "COLMAP";
  Camera& camera = result.raw.camera;
  const std::int64_t width = file.integer(fields[2], "width"),
                     height = file.integer(fields[3], "height");
  if (width < 1 || height < 1 || width > 20000 || height > 20000)
    file.fail("COLMAP's calibration: the size is not one of 1 to 20000 px");
  camera.width = static_cast<int>(width), camera.height = static_cast<int>(height);
  std::vector<double> p;
  for (std::size_t i = 4; i < fields.size(); ++i) p.push_back(file.number(fields[i], "parameter"));
  const std::string model(fields[1]);
  const bool one_focal = model == "SIMPLE_PINHOLE" || model == "SIMPLE_RADIAL" ||
                         model == "RADIAL" || model == "SIMPLE_RADIAL_FISHEYE";
  const std::size_t intrinsics = one_focal ? 3 : 4;
  const auto count = [&]() -> std::size_t {
    if (model == "SIMPLE_PINHOLE" || model == "PINHOLE") return 0;
    if (model == "SIMPLE_RADIAL") return 1;
    if (model == "RADIAL") return 2;
    if (model == "OPENCV" || model == "OPENCV_FISHEYE") return 4;
    if (model == "FULL_OPENCV") return 8;
    file.fail("COLMAP's calibration: the model " + in_quotes(model) +
              " is unknown: undistort the images");
  }();
  if (p.size() != intrinsics + count)
    file.fail(fmt::format("COLMAP's calibration: {} has {} parameters, not {}", model,
                          intrinsics + count, p.size()));
  camera.fx = p[0], camera.fy = one_focal ? p[0] : p[1];
  camera.cx = p[intrinsics - 2] - 0.5, camera.cy = p[intrinsics - 1] - 0.5;
  std::vector<double> d(p.begin() + static_cast<std::ptrdiff_t>(intrinsics), p.end());
  if (model == "OPENCV_FISHEYE") {
    camera.distortion = Distortion::kEquidistant;
    std::copy(d.begin(), d.end(), camera.coefficients.begin());
  } else if (!d.empty()) {
    d.resize(std::max<std::size_t>(d.size(), 4), 0);
    try {
      set_radial_tangential(d, result.raw);
    } catch (const ArgumentError& error) {
      file.fail(std::string("COLMAP's calibration: ") + error.what());
    }
  }
  return result;
}

}  // namespace

std::optional<ForeignCalibration> read_foreign_calibration(const std::string& path,
                                                           bool with_right) {
  TextFile file(path);
  std::string_view line;
  bool any = false;
  while (!any && file.next(line)) any = !line.empty();
  std::optional<ForeignCalibration> result;
  if (any && line.starts_with("<?xml"))
    result = read_opencv_xml(path);
  else if (path.ends_with(".txt"))
    result = read_colmap(path);
  else
    result = read_yaml(path, with_right);
  if (!result) return result;
  const Camera& camera = result->raw.camera;
  if (!(camera.fx > 0 && camera.fy > 0))
    throw FileError(path, result->program + "'s calibration: fx, fy: must be positive");
  return result;
}

}  // namespace placegraph
