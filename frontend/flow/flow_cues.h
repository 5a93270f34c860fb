#pragma once
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The camera's rotation between two images (that of T_1_2), from a gyro or an estimate.
struct KnownRotation {
  SO3 R_1_2;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< right tangent [rad^2]
};

/// Displacement of a point without the camera's rotation.
///
/// The point's position in the first image and, as if the camera had only translated, in the
/// second, both on the plane z = 1.
struct DerotatedFlow {
  Eigen::Vector2d start, end;
  Eigen::Matrix2d covariance;  ///< covariance of `end`, without that of the rotation
  Eigen::Matrix<double, 2, 3>
      J_end_rotation;  ///< derivative of `end` by the rotation's right tangent
  Eigen::Vector2d flow() const { return end - start; }
};

/// Removes the rotation from flow vectors.
///
/// Only full vectors are used; normal flow and points outside the lens model are left out.
/// Variances below (0.02 px)^2 are raised to that limit of the accuracy of flow.
std::vector<DerotatedFlow> derotate(const Camera& camera, const std::vector<FlowVector>& flow,
                                    const KnownRotation& rotation);

/// Motion of the camera relative to a plane, in units of the plane's distance.
struct VentralMotion {
  Outcome outcome;
  /// The camera's displacement in the axes of the first image over its distance from the plane
  /// there; divided by the time between the images it is speed over height [1/s].
  Eigen::Vector3d over_distance = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< from those of flow and rotation
  /// Derivative of `over_distance` by the right tangent of the removed rotation.
  Eigen::Matrix3d J_rotation = Eigen::Matrix3d::Zero();
  int inliers = 0;
  double chi2_per_dof = 0;
};

/// Motion from the flow of points on a plane with unit normal `normal`.
///
/// The normal points from the camera to the plane, in the axes of the first image. Exact for any
/// length of motion, as the derotated flow is linear in it. Robust by reweighting (Tukey's kernel).
/// `rotation_covariance` is that of the rotation, whose error is common to all vectors. Fails with
/// fewer than six vectors, a normal that is not a unit vector, or points that leave a direction
/// undetermined.
VentralMotion ventral_motion(const std::vector<DerotatedFlow>& flow, const Eigen::Vector3d& normal,
                             const Eigen::Matrix3d& rotation_covariance = Eigen::Matrix3d::Zero());

/// Time until the camera reaches the plane at constant velocity.
struct TimeToContact {
  Outcome outcome;
  double seconds = 0;  ///< time from the second image
  double sigma = 0;    ///< [s]
};

/// Time to contact from a ventral motion; `dt` is the time between the images [s].
///
/// Fails unless the motion is towards the plane by more than three standard deviations.
TimeToContact time_to_contact(const VentralMotion& motion, const Eigen::Vector3d& normal,
                              double dt);

/// First-order model of the derotated flow around the optical axis.
///
/// After Koenderink & van Doorn 1975, per image pair: flow = centre + gradient * (x, y).
struct AffineFlow {
  Outcome outcome;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  /// Covariance of (centre x, gradient's first row, centre y, its second row), from those of flow
  /// and rotation.
  Matrix6d covariance = Matrix6d::Zero();
  /// Twice the travelled share of the distance, for a plane that faces the camera.
  double divergence() const { return gradient.trace(); }
  double divergence_variance() const {
    return covariance(1, 1) + covariance(5, 5) + 2 * covariance(1, 5);
  }
};

/// Fits the affine flow; `rotation_covariance` as for `ventral_motion`.
///
/// Fails with fewer than six vectors or collinear points.
AffineFlow affine_flow(const std::vector<DerotatedFlow>& flow,
                       const Eigen::Matrix3d& rotation_covariance = Eigen::Matrix3d::Zero());

/// Difference of the flow speed between the right and the left half of the image.
///
/// Bees centre their flight in a corridor by keeping it at zero (Srinivasan et al. 1991).
struct LateralBalance {
  Outcome outcome;
  double left = 0, right = 0;  ///< mean length of the derotated flow on either side of the axis
  double balance = 0;          ///< (right - left) / (right + left), in [-1, 1]
  double sigma = 0;            ///< standard deviation of `balance`, from flow and rotation
};

/// Computes the lateral balance; `rotation_covariance` as for `ventral_motion`.
///
/// Fails with fewer than three vectors on a side or with negligible flow.
LateralBalance lateral_balance(
    const std::vector<DerotatedFlow>& flow,
    const Eigen::Matrix3d& rotation_covariance = Eigen::Matrix3d::Zero());

}  // namespace placegraph
