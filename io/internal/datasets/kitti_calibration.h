#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace placegraph {

/// The numbers behind `KEY:` in a calibration file of KITTI, with the line they stand on.
struct KittiLine {
  std::vector<double> numbers;
  int line = 0;
};
using KittiLines = std::map<std::string, KittiLine, std::less<>>;

/// Reads the lines whose key is wanted, with so many numbers; `P_rect_00` (KITTI raw) counts as
/// `P0`. Other keys (Tr, ...) are passed over. Throws FileError with the line: a wrong number of
/// numbers, a key that is there twice.
KittiLines read_kitti_lines(const std::string& path,
                            const std::vector<std::pair<std::string, std::size_t>>& wanted);

/// The ideal pinhole in a 3x4 projection matrix; the size is left open. Throws FileError if it is
/// none.
Camera kitti_camera(const std::string& path, const std::string& key, const KittiLine& P);

/// A camera of unknown size gets that of its first image. Throws FileError naming the image if it
/// is none for that camera.
void set_size(const std::string& first_image, const Image& image, Camera& camera);

/// The rectified cameras `left` and `left + 1` of a calib.txt or calib_cam_to_cam.txt; the image
/// size is not among it and left 0.
struct KittiCameras {
  Camera camera;
  double baseline_m = 0;                                       ///< 0 without a right eye
  Eigen::Vector3d position_in_cam0 = Eigen::Vector3d::Zero();  ///< of the left eye, rectified
};
/// `with_right`: there are images of a right eye. Throws FileError for a file without the left
/// camera, a right eye with other intrinsics, or one that is not to the right.
KittiCameras read_kitti_cameras(const std::string& path, int left, bool with_right);

/// What the lines P0 and P1 of a calib.txt say; the image size is not among it and left 0.
struct KittiCalibration {
  Camera camera;
  double baseline_m = 0;  ///< 0 where there is no P1
};
/// Throws FileError with the line for a file without P0, or whose P0 or P1 is no ideal pinhole.
KittiCalibration read_kitti_calibration(const std::string& path);

}  // namespace placegraph
