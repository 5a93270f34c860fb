#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// One moment's measurements, as a data set or a driver hands them over. Images are those of the
/// Calibration's cameras: undistorted (and, for stereo, rectified). Absent images are empty.
struct Frame {
  FrameId id;                 ///< index in its sequence
  std::int64_t stamp_ns = 0;  ///< strictly increasing
  Image image;                ///< CV_8UC1, the left or only eye
  Image right;                ///< CV_8UC1, rectified right eye
  Image depth;                ///< CV_32FC1 [m], in the depth camera's own pixel grid; 0 = none
  Image colour;               ///< CV_8UC3 BGR of `image`, where the source has colour
  Image mask;                 ///< CV_8UC1, 0 = do not use (sky, own bonnet, moving things)
};

}  // namespace placegraph
