#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Inverse depth (1 / z in the camera [1/m]) at the two ends of a segment; it is affine between
/// them. Errors of the two ends are independent.
struct DepthAlong {
  double inverse_depth_start = 0, inverse_depth_end = 0;
  double sigma = 0;  ///< of either [1/m]
};

/// Depths along segments of the colour image from a depth image in its own camera's grid. On either
/// side of an edge a plane is fitted to the depths near it (its inverse depth is affine in the
/// image) and carried to the edge; where the two sides disagree, the edge is the nearer one's, as
/// the farther surface only shows behind it. Nothing where no side has depths along most of the
/// segment that lie on one plane.
std::vector<std::optional<DepthAlong>> lookup_depth_along(const Image& depth_m,
                                                          const Camera& camera,
                                                          const DepthCamera& depth_camera,
                                                          const std::vector<LineSegment>& segments);

/// A segment as an eye beside the camera would see it, displaced across the segment, so that the
/// depths along it become a shift across its image: a right eye where there is only depth.
struct VirtualCamera {
  Eigen::Vector3d second_in_cam = Eigen::Vector3d::Zero();
  ImageLine::Carriers seen;
};
VirtualCamera virtual_camera_from_depth(const Camera& camera, const LineSegment& segment,
                                        const DepthAlong& depth);

}  // namespace placegraph
