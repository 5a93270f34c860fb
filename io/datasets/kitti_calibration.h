#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace placegraph {

/// The numbers after `KEY:` in a calibration file of KITTI, with their line.
struct KittiLine {
  std::vector<double> numbers;
  int line = 0;
};
using KittiLines = std::map<std::string, KittiLine, std::less<>>;

/// Reads the lines with the wanted keys, each with its number of fields; `P_rect_00` (KITTI raw)
/// counts as `P0`. Other keys (Tr, ...) are skipped. Throws FileError with the line: a wrong number
/// of numbers, a duplicate key.
KittiLines read_kitti_lines(const std::string& path,
                            const std::vector<std::pair<std::string, std::size_t>>& wanted);

/// The ideal pinhole in a 3x4 projection matrix; the size is not set. Throws FileError if the
/// matrix is not one.
Camera kitti_camera(const std::string& path, const std::string& key, const KittiLine& P);

/// Sets the size of a camera of unknown size from its first image. Throws FileError that names the
/// image if that size is impossible for the camera.
void set_size(const std::string& first_image, const Image& image, Camera& camera);

/// The rectified cameras `left` and `left + 1` of a calib.txt or calib_cam_to_cam.txt; the image
/// size is not in the file and remains 0.
struct KittiCameras {
  Camera camera;
  double baseline_m = 0;  ///< 0 without a right camera
  bool paired = false;    ///< whether the file describes the right camera, with images or without
  Eigen::Vector3d position_in_cam0 = Eigen::Vector3d::Zero();  ///< rectified left camera
};
/// `with_right`: there are images of a right camera. Throws FileError for a file without the left
/// camera, a right camera with other intrinsics, or one that is not to the right.
KittiCameras read_kitti_cameras(const std::string& path, int left, bool with_right);

/// The lines P0 and P1 of a calib.txt; the image size is not in the file and remains 0.
struct KittiCalibration {
  Camera camera;
  double baseline_m = 0;  ///< 0 where there is no P1
};
/// Throws FileError with the line for a file without P0, or if P0 or P1 is not an ideal pinhole.
KittiCalibration read_kitti_calibration(const std::string& path);

}  // namespace placegraph
