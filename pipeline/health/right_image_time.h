#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A pixel of the left image and the same point in the right one.
struct StereoMatch {
  Eigen::Vector2d px_left, px_right;
};

/// Position of the right camera in the left camera's frame, as a share of its x coordinate: (y, z)
/// / x, which is zero for a rectified pair.
struct RightCameraOffset {
  Eigen::Vector2d yz_share = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
};

/// Measures the offset of the right camera by robust least squares over the epipolar constraints
///
///   y_r - y_l = g_z (d y_r + (y_r - y_l) x_r) - g_y d + rotation,   d = x_l - x_r
///
/// (rays with z = 1, g = yz_share). A rotation of the right camera, as a polynomial of the second
/// order over the image, is estimated too. Nothing for fewer than thirty matches.
std::optional<RightCameraOffset> right_camera_offset(const Camera& camera,
                                                     const std::vector<StereoMatch>& matches);

/// Finds right images that were taken at another time than the left ones: the camera's own motion
/// is then added to the baseline. The offset of the right camera, by matches that may leave their
/// rows, is compared with the motion of the left camera between two frames.
class RightImageTime {
 public:
  explicit RightImageTime(const Calibration& calibration);

  /// Adds a frame with its pose; matches the two images of one frame in some.
  void add(const Frame& frame, const std::optional<SE3>& T_map_cam);
  /// Adds the offset of one pair; `motion_m`: the motion of the camera since the frame before.
  void add(const RightCameraOffset& offset, const Eigen::Vector3d& motion_m);
  /// Reports the offset if it follows the motion: by a tenth of it and by five standard deviations
  /// in at least three pairs.
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(pairs_, frames_since_pair_); }

 private:
  struct Pair {
    RightCameraOffset offset;
    Eigen::Vector2d motion_yz_share;  // motion of a frame (y, z), as a share of the baseline
    void visit_state(auto& archive) {
      archive(offset.yz_share, offset.information, motion_yz_share);
    }
  };
  struct Lateness {
    double frames = 0, sigma = 0;
  };
  Lateness lateness() const;

  Camera camera_;
  double baseline_m_;
  std::vector<Pair> pairs_;
  std::optional<SE3> T_map_last_;
  int frames_since_pair_ = 0;
};

}  // namespace placegraph
