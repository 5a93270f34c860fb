#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <cstddef>

namespace placegraph {

/// Depth of the pixels of a keyframe's image, at the map's scale.
struct KeyframeDepth {
  Camera camera;        ///< camera of the depth image, without distortion
  SE3 T_map_cam;        ///< pose of that camera
  Image depth;          ///< CV_32FC1 along the optical axis, 0 = none
  Image sigma_inverse;  ///< CV_32FC1, standard deviation of 1 / depth where there is a depth
  Image colour;         ///< CV_8UC3 BGR, of the size of the depth image
  Image normal;  ///< CV_32FC3 towards the camera, in its frame, 0 = none; empty until estimated
};

/// Where the depth of a map's keyframes is from: a sensor, a stereo pair, neighbouring views, or
/// another source that is filtered.
class DepthOfKeyframe {
 public:
  virtual ~DepthOfKeyframe() = default;
  /// Number of keyframes.
  virtual std::size_t size() const = 0;
  /// Depth of a keyframe, which is at `index` in the order of time. Calls with ascending indices
  /// read every image once.
  virtual KeyframeDepth of(std::size_t index) = 0;
};

}  // namespace placegraph
