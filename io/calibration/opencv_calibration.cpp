#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_reader.h>
#include <placegraph/io/calibration/opencv_calibration.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

void set_size(const CalibrationReader& reader, const YAML::Node& root, Camera& camera) {
  for (const char* key : {"image_width", "width", "imageWidth", "Image_Width"})
    if (root[key].IsDefined()) camera.width = reader.side(reader.number(root, key), root[key]);
  for (const char* key : {"image_height", "height", "imageHeight", "Image_Height"})
    if (root[key].IsDefined()) camera.height = reader.side(reader.number(root, key), root[key]);
  const YAML::Node both = first_of(root, {"image_size", "imageSize", "size"});
  if (!both.IsDefined()) return;
  const std::vector<double> size = reader.numbers(both, "image size", 2);
  camera.width = reader.side(size[0], both), camera.height = reader.side(size[1], both);
}

RawCamera read_opencv_camera(const CalibrationReader& reader, const YAML::Node& root,
                             const YAML::Node& matrix, const YAML::Node& coefficients) {
  RawCamera raw;
  reader.set_matrix(matrix, raw.camera);
  set_size(reader, root, raw.camera);
  const YAML::Node model = first_of(root, {"distortion_model"});
  if (coefficients.IsDefined() && !coefficients.IsNull())
    reader.set_distortion(model.IsDefined() ? model.Scalar() : "",
                          reader.numbers(coefficients, "distortion coefficients"), coefficients,
                          raw);
  return raw;
}

/// R and T of cv::stereoCalibrate map points of the first camera into the second.
SE3 stereo_T_left_right(const CalibrationReader& reader, const YAML::Node& root) {
  const YAML::Node R_node = first_of(root, {"R", "Rotation"}),
                   T_node = first_of(root, {"T", "Translation"});
  if (!R_node.IsDefined() || !T_node.IsDefined())
    reader.fail(root,
                "R, T: are missing; they are the pose of the second camera, whose images are in "
                "right/");
  const std::vector<double> r = reader.numbers(R_node, "R"), t = reader.numbers(T_node, "T", 3);
  if (r.size() != 9 && r.size() != 3)
    reader.fail(R_node, "R: a rotation has 9 numbers, or 3 as a vector");
  cv::Matx33d R;
  if (r.size() == 3)
    cv::Rodrigues(cv::Vec3d(r[0], r[1], r[2]), R);
  else
    R = cv::Matx33d(r.data());
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R_right_left(R.val);
  return reader.motion(R_right_left, {t[0], t[1], t[2]}, R_node).inverse();
}

/// Reads two cameras from one file.
std::optional<ForeignCalibration> read_stereo(const YamlDocument& yaml, bool with_right) {
  const YAML::Node& root = yaml.root();
  const YAML::Node K1 = first_of(root, {"K1", "M1", "cameraMatrix1", "camera_matrix_1"});
  if (!K1.IsDefined()) return std::nullopt;
  ForeignCalibration result;
  result.program = "OpenCV";
  const CalibrationReader reader(yaml, result.program);
  result.raw =
      read_opencv_camera(reader, root, K1, first_of(root, {"D1", "distCoeffs1", "dist_coeffs_1"}));
  if (!with_right) return result;
  const YAML::Node K2 = first_of(root, {"K2", "M2", "cameraMatrix2", "camera_matrix_2"});
  if (!K2.IsDefined()) reader.fail(root, "K2: is missing, the camera of the images in right/");
  result.right = RightCamera{
      read_opencv_camera(reader, root, K2, first_of(root, {"D2", "distCoeffs2", "dist_coeffs_2"})),
      stereo_T_left_right(reader, root)};
  return result;
}

}  // namespace

std::optional<ForeignCalibration> read_opencv_yaml(const YamlDocument& yaml, bool with_right) {
  if (auto stereo = read_stereo(yaml, with_right)) return stereo;
  const YAML::Node& root = yaml.root();
  const YAML::Node matrix =
      first_of(root, {"camera_matrix", "Camera_Matrix", "cameraMatrix", "K", "k"});
  if (!matrix.IsDefined()) return std::nullopt;
  ForeignCalibration result;
  result.program = root["distortion_model"].IsDefined() ? "ROS" : "OpenCV";
  const CalibrationReader reader(yaml, result.program);
  result.raw = read_opencv_camera(
      reader, root, matrix,
      first_of(root, {"distortion_coefficients", "Distortion_Coefficients", "distCoeffs",
                      "dist_coeffs", "distortion_coeffs", "D", "d"}));
  return result;
}

ForeignCalibration read_opencv_xml(const std::string& path) {
  ForeignCalibration result;
  result.program = "OpenCV";
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ);
    cv::Mat K, d;
    for (const char* key : {"camera_matrix", "Camera_Matrix", "cameraMatrix", "K"})
      if (!file[key].empty()) file[key] >> K;
    for (const char* key :
         {"distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "D"})
      if (!file[key].empty()) file[key] >> d;
    if (K.total() != 9)
      throw FileError(path, "OpenCV's calibration: no camera matrix of 9 numbers");
    K.convertTo(K, CV_64F);
    d.convertTo(d, CV_64F);
    Camera& camera = result.raw.camera;
    camera.fx = K.at<double>(0, 0), camera.cx = K.at<double>(0, 2);
    camera.fy = K.at<double>(1, 1), camera.cy = K.at<double>(1, 2);
    for (const char* key : {"image_width", "image_Width", "width"})
      if (!file[key].empty()) camera.width = static_cast<int>(file[key]);
    for (const char* key : {"image_height", "image_Height", "height"})
      if (!file[key].empty()) camera.height = static_cast<int>(file[key]);
    const std::vector<double> coefficients(d.begin<double>(), d.end<double>());
    if (std::any_of(coefficients.begin(), coefficients.end(), [](double k) { return k != 0; }))
      set_radial_tangential(coefficients, result.raw);
  } catch (const cv::Exception& error) {
    throw FileError(path, std::string("OpenCV's calibration: ") + error.err);
  } catch (const ArgumentError& error) {
    throw FileError(path, std::string("OpenCV's calibration: ") + error.what());
  }
  return result;
}

}  // namespace placegraph
