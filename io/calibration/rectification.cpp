#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/rectification.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

cv::Mat camera_matrix(const Camera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

cv::Mat coefficients(const RawCamera& raw) {
  return cv::Mat(raw.coefficients(), true).reshape(1, 1);
}

Remap make_remap(const RawCamera& raw, const cv::Mat& R_new_raw, const cv::Mat& K_new) {
  Remap remap;
  const Camera& camera = raw.camera;
  const cv::Size size(camera.width, camera.height);
  if (camera.distortion == Distortion::kEquidistant) {
    cv::fisheye::initUndistortRectifyMap(camera_matrix(camera), coefficients(raw), R_new_raw, K_new,
                                         size, CV_32FC1, remap.map_x, remap.map_y);
  } else {
    cv::initUndistortRectifyMap(camera_matrix(camera), coefficients(raw), R_new_raw, K_new, size,
                                CV_32FC1, remap.map_x, remap.map_y);
  }
  return remap;
}

Camera pinhole(const Camera& raw, const cv::Mat& K) {
  Camera camera;
  camera.width = raw.width;
  camera.height = raw.height;
  camera.fx = K.at<double>(0, 0);
  camera.fy = K.at<double>(1, 1);
  camera.cx = K.at<double>(0, 2);
  camera.cy = K.at<double>(1, 2);
  return camera;
}

SO3 rotation_from(const cv::Mat& R) {
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix(row, column) = R.at<double>(row, column);
  }
  return SO3::from_matrix(matrix);
}

}  // namespace

Image Remap::bilinear(const Image& raw) const {
  if (is_identity()) return raw;
  Image out;
  cv::remap(raw, out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return out;
}

Image Remap::nearest(const Image& raw) const {
  if (is_identity()) return raw;
  Image out;
  cv::remap(raw, out, map_x, map_y, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return out;
}

UndistortedCamera undistort_camera(const RawCamera& raw) {
  raw.check();
  const Camera& camera = raw.camera;
  if (camera.distortion == Distortion::kNone) return {camera, {}};
  const cv::Size size(camera.width, camera.height);
  cv::Mat K;
  if (camera.distortion == Distortion::kEquidistant) {
    cv::fisheye::estimateNewCameraMatrixForUndistortRectify(
        camera_matrix(camera), coefficients(raw), size, cv::Mat::eye(3, 3, CV_64F), K, 0.0);
  } else {
    K = cv::getOptimalNewCameraMatrix(camera_matrix(camera), coefficients(raw), size, 0.0);
  }
  UndistortedCamera result{pinhole(camera, K), make_remap(raw, cv::Mat::eye(3, 3, CV_64F), K)};
  result.camera.check();
  return result;
}

RectifiedStereo rectify_stereo(const RawCamera& raw_left, const RawCamera& raw_right,
                               const SE3& T_left_right) {
  raw_left.check();
  raw_right.check();
  const Camera &left = raw_left.camera, &right = raw_right.camera;
  const bool fisheye = left.distortion == Distortion::kEquidistant;
  if (fisheye != (right.distortion == Distortion::kEquidistant)) {
    throw ArgumentError("stereo: the two cameras have different distortion models");
  }
  if (left.width != right.width || left.height != right.height) {
    throw ArgumentError("stereo: the two cameras have different image sizes");
  }
  // OpenCV expects the transformation of points from the left camera's frame to the right one's.
  const SE3 T_right_left = T_left_right.inverse();
  const Eigen::Matrix3d R_eigen = T_right_left.rotation().matrix();
  const Eigen::Vector3d t_eigen = T_right_left.translation();
  cv::Mat R(3, 3, CV_64F), t(3, 1, CV_64F), R1, R2, P1, P2, Q;
  for (int row = 0; row < 3; ++row) {
    t.at<double>(row) = t_eigen[row];
    for (int column = 0; column < 3; ++column) R.at<double>(row, column) = R_eigen(row, column);
  }
  const cv::Size size(left.width, left.height);
  if (fisheye) {
    cv::fisheye::stereoRectify(camera_matrix(left), coefficients(raw_left), camera_matrix(right),
                               coefficients(raw_right), size, R, t, R1, R2, P1, P2, Q,
                               cv::CALIB_ZERO_DISPARITY, size, 0.0, 1.0);
  } else {
    cv::stereoRectify(camera_matrix(left), coefficients(raw_left), camera_matrix(right),
                      coefficients(raw_right), size, R, t, R1, R2, P1, P2, Q,
                      cv::CALIB_ZERO_DISPARITY, 0.0, size);
  }
  RectifiedStereo result;
  result.camera = pinhole(left, P1);
  result.baseline_m = -P2.at<double>(0, 3) / P2.at<double>(0, 0);
  if (P2.at<double>(1, 3) != 0 || !(result.baseline_m > 0)) {
    throw ArgumentError("stereo: the right camera is not to the right of the left one");
  }
  result.camera.check();
  result.left = make_remap(raw_left, R1, P1);
  result.right = make_remap(raw_right, R2, P2);
  result.T_left_rectified = SE3(rotation_from(R1).inverse(), Eigen::Vector3d::Zero());
  return result;
}

}  // namespace placegraph
