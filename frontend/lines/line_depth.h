#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Inverse depth (1 / z in the camera [1/m]) at the two ends of a segment.
///
/// It is affine between them. Errors of the two ends are independent.
struct DepthAlong {
  double inverse_depth_start = 0, inverse_depth_end = 0;
  double sigma = 0;  ///< standard deviation of either end [1/m]
};

/// Depths along segments of the colour image from a depth image in its own camera's grid.
///
/// On either side of an edge a plane is fitted to the depths near it (its inverse depth is affine
/// in the image) and extrapolated to the edge. If the two sides disagree, the edge belongs to the
/// nearer surface, which occludes the farther one. Nothing if neither side has depths on one plane
/// along most of the segment.
std::vector<std::optional<DepthAlong>> lookup_depth_along(const Image& depth_m,
                                                          const Camera& camera,
                                                          const DepthCamera& depth_camera,
                                                          const std::vector<LineSegment>& segments);

/// A segment in a virtual second camera beside the first.
///
/// The camera is displaced across the segment, so that the depths along the segment become a shift
/// across its image. It replaces the right camera if there is only a depth image.
struct VirtualCamera {
  Eigen::Vector3d second_in_cam = Eigen::Vector3d::Zero();
  ImageLine::Carriers seen;
};
/// The virtual camera of a segment with known depths.
VirtualCamera virtual_camera_from_depth(const Camera& camera, const LineSegment& segment,
                                        const DepthAlong& depth);

}  // namespace placegraph
