#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_reader.h>
#include <placegraph/io/calibration/kalibr_calibration.h>
#include <placegraph/io/files/text_file.h>

namespace placegraph {
namespace {

RawCamera read_kalibr_camera(const CalibrationReader& reader, const YAML::Node& cam) {
  const std::string model = cam["camera_model"].IsDefined() ? cam["camera_model"].Scalar() : "";
  if (model != "pinhole")
    reader.fail(cam, "camera_model: " + in_quotes(model) + " is not supported, only pinhole");
  if (!cam["intrinsics"].IsDefined()) reader.fail(cam, "intrinsics: is missing");
  const std::vector<double> k = reader.numbers(cam["intrinsics"], "intrinsics", 4);
  RawCamera raw;
  Camera& camera = raw.camera;
  camera.fx = k[0], camera.fy = k[1], camera.cx = k[2], camera.cy = k[3];
  if (const YAML::Node resolution = cam["resolution"]; resolution.IsDefined()) {
    const std::vector<double> size = reader.numbers(resolution, "resolution", 2);
    camera.width = reader.side(size[0], resolution);
    camera.height = reader.side(size[1], resolution);
  }
  if (const YAML::Node d = cam["distortion_coeffs"]; d.IsDefined())
    reader.set_distortion(
        cam["distortion_model"].IsDefined() ? cam["distortion_model"].Scalar() : "radtan",
        reader.numbers(d, "distortion_coeffs"), d, raw);
  return raw;
}

/// T_cn_cnm1 maps points from the previous camera into this one.
SE3 chain_T_left_right(const CalibrationReader& reader, const YAML::Node& cam1) {
  const YAML::Node node = cam1["T_cn_cnm1"];
  if (!node.IsDefined())
    reader.fail(cam1, "T_cn_cnm1: is missing; it is the pose of cam1, whose images are in right/");
  const std::vector<double> numbers = reader.numbers(node, "T_cn_cnm1", 16);
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> T_right_left(numbers.data());
  return reader
      .motion(T_right_left.topLeftCorner<3, 3>(), T_right_left.topRightCorner<3, 1>(), node)
      .inverse();
}

}  // namespace

ForeignCalibration read_kalibr(const YamlDocument& yaml, bool with_right) {
  ForeignCalibration result;
  result.program = "Kalibr";
  const CalibrationReader reader(yaml, result.program);
  result.raw = read_kalibr_camera(reader, yaml.root()["cam0"]);
  if (const YAML::Node cam1 = yaml.root()["cam1"]; with_right && cam1.IsDefined()) {
    if (!cam1.IsMap()) reader.fail(cam1, "cam1: is not a camera");
    result.right = RightCamera{read_kalibr_camera(reader, cam1), chain_T_left_right(reader, cam1)};
  }
  return result;
}

}  // namespace placegraph
