#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/dense/keyframe_depth.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <functional>
#include <memory>
#include <vector>

namespace placegraph {

/// The images of a keyframe, undistorted as Calibration says.
using FrameOfKeyframe = std::function<Frame(const Keyframe&)>;

/// Keyframes with their images.
struct PosedImages {
  std::vector<PosedKeyframe> keyframes;  ///< in the order of time
  Calibration calibration;               ///< calibration of the images
  FrameOfKeyframe frame_of;              ///< reads them
};

/// Depths of the landmarks that the keyframes observe, at the map's scale.
struct DepthRange {
  double near = 0;    ///< 98 % of the observations are farther
  double median = 0;  ///< median of the observations
  double far = 0;     ///< 98 % of the observations are nearer
};

/// The range of depths in a map; all zero without observations.
DepthRange depth_range_of(const MapGeometry& geometry);

/// Depth images of an RGB-D camera, in their own pixel grid, with the colours of the other camera.
std::unique_ptr<DepthOfKeyframe> depth_by_sensor(PosedImages images);

/// Depth of a rectified stereo pair by semi-global matching, down to half the near depth.
std::unique_ptr<DepthOfKeyframe> depth_by_stereo(PosedImages images, const DepthRange& range);

/// Depth of one camera by planes that are swept between neighbouring keyframes: before and after,
/// one at a distance of about 5 % of the median depth and one at 15 %, which see the same.
std::unique_ptr<DepthOfKeyframe> depth_by_sweep(PosedImages images, const DepthRange& range);

}  // namespace placegraph
