#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// The images of one moment, as a data set or a driver hands them over.
/// They are those of the Calibration's cameras: undistorted and, for stereo, rectified. Absent
/// images are empty.
struct Frame {
  FrameId id;                 ///< index in its sequence
  std::int64_t stamp_ns = 0;  ///< strictly increasing
  Image image;                ///< CV_8UC1, of the left or only camera
  Image right;                ///< CV_8UC1, of the right camera of a rectified stereo pair
  Image depth;                ///< CV_32FC1 [m], in the depth camera's own pixel grid; 0 = none
  Image colour;               ///< CV_8UC3 BGR of `image`, where the source has colour
  Image mask;                 ///< CV_8UC1 of `image`, 0 = ignore (sky, own bonnet, moving objects)
};

}  // namespace placegraph
