#pragma once
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/plane3.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Plane in a depth image, in the frame of its camera.
struct DepthPlane {
  Plane3 plane_cam;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of its tangent
  /// Points on the plane, in the middle of each of its cells.
  std::vector<Eigen::Vector3d> points_cam;
};

/// Finds the planes of a depth image (CV_32FC1 [m], 0 = none), the largest first.
///
/// The search takes a few milliseconds and can be used for every keyframe; find_cloud_planes is
/// more thorough. The inverse depth of a plane n^T X = d is linear in the ray, 1/z = (n/d)^T ray,
/// and the noise of depth cameras and stereo, which grows with the square of the depth, is the same
/// for all inverse depths. Cells of the image, each with its sums, are merged while their means
/// agree with one plane up to the deviations of cell means in the whole image, and `flatness`;
/// coplanar parts are merged if the gap between them is not wider than the larger one. The
/// covariance is that of residuals that blocks of pixels have in common (Liang & Zeger 1986,
/// "Longitudinal data analysis using generalized linear models": sums over clusters), so that
/// neighbouring pixels with correlated errors count as one; it is at least that of independent
/// cells, and the floor. Throws ArgumentError for an image of another size or type.
std::vector<DepthPlane> find_depth_planes(const Image& depth_m, const Camera& depth_camera,
                                          const DepthPlanesOptions& options = {});

/// Transforms a plane to another frame.
DepthPlane transform(const SE3& T_new_old, const DepthPlane& plane_old);

}  // namespace placegraph
