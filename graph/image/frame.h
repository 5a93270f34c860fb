#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// The images taken at one time, as a data set or a driver delivers them.
/// They are images of the cameras of Calibration: undistorted and, for stereo, rectified. Missing
/// images are empty.
struct Frame {
  FrameId id;                 ///< index in its sequence
  std::int64_t stamp_ns = 0;  ///< strictly increasing
  Image image;                ///< image of the left or only camera, CV_8UC1
  Image right;                ///< image of the right camera of a rectified stereo pair, CV_8UC1
  Image depth;   ///< depth image, CV_32FC1 [m], in the depth camera's own pixel grid; 0 = none
  Image colour;  ///< CV_8UC3 BGR version of `image`, if the source has colour
  Image mask;    ///< mask of `image`, CV_8UC1, 0 = ignore (sky, own bonnet, moving objects)
};

}  // namespace placegraph
