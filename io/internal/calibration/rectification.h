#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/io/internal/calibration/raw_camera.h>

namespace placegraph {

/// Resamples the images of one raw camera into those of an ideal pinhole. Immutable: may be used
/// from several threads. A default one leaves images as they are.
struct Remap {
  Image map_x,
      map_y;  ///< CV_32FC1: for each pixel of the output where to look in the raw image [px]

  bool is_identity() const { return map_x.empty(); }
  /// Bilinear; the border's pixels go on outside the raw image, so that no dark edge appears.
  Image bilinear(const Image& raw) const;
  /// Nearest neighbour, for depth: neighbours across an edge are never mixed; 0 outside.
  Image nearest(const Image& raw) const;
};

/// A camera without distortion and how its images come from the raw one's. The viewing direction
/// stays (no rotation); the image is scaled so that no pixel lies
/// more than about one pixel outside the raw image.
struct UndistortedCamera {
  Camera camera;
  Remap remap;
};

/// Identity for a camera without distortion. Throws ArgumentError for an invalid camera.
UndistortedCamera undistort_camera(const RawCamera& raw);

/// Two raw eyes made parallel: rows correspond, same intrinsics.
struct RectifiedStereo {
  Camera camera;
  double baseline_m = 0;
  Remap left, right;
  SE3 T_left_rectified;  ///< from the rectified left camera to the raw left one: a rotation
};

/// Bouguet's rectification (cv::stereoRectify, cv::fisheye::stereoRectify) from the raw cameras and
/// `T_left_right`. Throws ArgumentError if the distortion models differ, or the right eye is not to
/// the right of the left one.
RectifiedStereo rectify_stereo(const RawCamera& left, const RawCamera& right,
                               const SE3& T_left_right);

}  // namespace placegraph
