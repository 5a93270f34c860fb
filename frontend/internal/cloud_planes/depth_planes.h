#pragma once
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/plane3.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// A plane in a depth image, in the frame of its camera.
struct DepthPlane {
  Plane3 plane_cam;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of its tangent
  std::vector<Eigen::Vector3d> points_cam;  ///< on the plane, in the middle of each of its cells
};

/// The planes of a depth image (CV_32FC1 [m], 0 = none), the largest first, in a few milliseconds:
/// for a program that looks at every keyframe, where find_cloud_planes looks closer. Of a plane
/// n^T X = d the inverse depth is linear in the ray, 1/z = (n/d)^T ray, and the noise of depth
/// cameras and stereo, growing with the square of the depth, is the same for all of them. Cells of
/// the image, each with its sums, grow together while their means fit one plane to what cell means
/// are off by in the image as a whole, and `flatness`; coplanar parts are one where the gap between
/// them is not wider than the larger. The covariance is that of residuals which blocks of pixels
/// have in common (Liang & Zeger 1986, "Longitudinal data analysis using generalized linear
/// models": sums over clusters), so that neighbouring pixels that err alike count as one, never
/// less than independent cells would leave, and the floor. Throws ArgumentError for an image of
/// another size or type.
std::vector<DepthPlane> find_depth_planes(const Image& depth_m, const Camera& depth_camera,
                                          const DepthPlanesOptions& options = {});

/// The same plane in another frame.
DepthPlane transform(const SE3& T_new_old, const DepthPlane& plane_old);

}  // namespace placegraph
