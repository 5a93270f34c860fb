#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/io/calibration/raw_camera.h>

namespace placegraph {

/// Resamples the images of one raw camera into those of an ideal pinhole. Immutable: may be used
/// from several threads. A default-constructed one leaves images unchanged.
struct Remap {
  Image map_x,
      map_y;  ///< CV_32FC1: for each pixel of the output its position in the raw image [px]

  bool is_identity() const { return map_x.empty(); }
  /// Bilinear; outside the raw image the border's pixels are repeated, so that no dark edge
  /// appears.
  Image bilinear(const Image& raw) const;
  /// Nearest neighbour, for depth: neighbours across an edge are never mixed; 0 outside.
  Image nearest(const Image& raw) const;
};

/// A camera without distortion and the mapping of its images from the raw camera's. The viewing
/// direction does not change (no rotation); the image is scaled so that no pixel is more than about
/// one pixel outside the raw image.
struct UndistortedCamera {
  Camera camera;
  Remap remap;
};

/// Identity for a camera without distortion. Throws ArgumentError for an invalid camera.
UndistortedCamera undistort_camera(const RawCamera& raw);

/// A rectified stereo pair: rows correspond, same intrinsics.
struct RectifiedStereo {
  Camera camera;
  double baseline_m = 0;
  Remap left, right;
  SE3 T_left_rectified;  ///< from the rectified left camera to the raw left one: a rotation
};

/// Bouguet's rectification (cv::stereoRectify, cv::fisheye::stereoRectify) from the raw cameras and
/// `T_left_right`. Throws ArgumentError if the distortion models differ, or the right camera is not
/// to the right of the left one.
RectifiedStereo rectify_stereo(const RawCamera& left, const RawCamera& right,
                               const SE3& T_left_right);

}  // namespace placegraph
