#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Plane n^T X = d in a camera frame, |n| = 1, d > 0 [m].
///
/// The normal points from the camera to the plane.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();
  double distance_m = 1;
};

/// Plane in another camera frame: n' = R n, d' = d + n'^T t for T_cur_ref = (R, t).
Plane transform(const SE3& T_cur_ref, const Plane& plane_ref);

/// H_cur_ref = K (R + t n^T / d) K^-1 with T_cur_ref = (R, t).
///
/// On the plane px_cur ~ H px_ref.
Eigen::Matrix3d homography_from_plane(const Eigen::Matrix3d& K, const SE3& T_cur_ref,
                                      const Plane& plane_ref);

/// One solution for a homography's motion: T_cur_ref with t over the plane's distance.
struct HomographyMotion {
  SE3 T_cur_ref;
  Eigen::Vector3d normal_ref;
};

/// Physically possible solutions for a homography (Malis & Vargas 2007, by OpenCV).
///
/// They have all of `px_ref` in front of the camera on the plane; two for a general motion, one of
/// them the true one.
std::vector<HomographyMotion> decompose_homography(const Eigen::Matrix3d& K,
                                                   const Eigen::Matrix3d& H_cur_ref,
                                                   const std::vector<Eigen::Vector2d>& px_ref);

/// The single solution for a known unit normal.
///
/// M = K^-1 H K over its middle singular value, R = orth([Mu Mv Mu x Mv][u v n]^T), t = (M - R) n,
/// over the plane's distance. Throws ArgumentError if the normal is not of unit length (1e-6) or H
/// is singular.
SE3 motion_from_homography(const Eigen::Matrix3d& K, const Eigen::Matrix3d& H_cur_ref,
                           const Eigen::Vector3d& normal_ref);

}  // namespace placegraph
