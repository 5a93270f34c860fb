#pragma once
#include <placegraph/frontend/internal/flow/flow_vector.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// The camera's turn between two images, T_1_2's rotation, as a gyro or an estimate has it.
struct KnownRotation {
  SO3 R_1_2;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< right tangent [rad^2]
};

/// What the displacement of a point is without the camera's turn: its place in the first image and,
/// as if the camera had only moved on, in the second, both on the plane z = 1.
struct DerotatedFlow {
  Eigen::Vector2d start, end;
  Eigen::Matrix2d covariance;                  ///< of `end`, without the turn's
  Eigen::Matrix<double, 2, 3> J_end_rotation;  ///< of `end` by the turn's right tangent
  Eigen::Vector2d flow() const { return end - start; }
};

/// Full vectors only, normal ones and points beyond the lens model are left out. Variances below
/// (0.02 px)^2 are raised to that: no flow is known better.
std::vector<DerotatedFlow> derotate(const Camera& camera, const std::vector<FlowVector>& flow,
                                    const KnownRotation& rotation);

/// Motion of the camera beside a plane, in units of the plane's distance.
struct VentralMotion {
  Outcome outcome;
  /// The camera's displacement in the axes of the first image, over its distance from the plane
  /// there; divided by the time between the images it is speed over height [1/s].
  Eigen::Vector3d over_distance = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< from the flow's and the turn's
  /// Of `over_distance` by the right tangent of the turn that was taken out.
  Eigen::Matrix3d J_rotation = Eigen::Matrix3d::Zero();
  int inliers = 0;
  double chi2_per_dof = 0;
};

/// From the flow of points on a plane with unit normal `normal` (pointing from the camera to the
/// plane, in the axes of the first image): exact for any length of motion, as the derotated flow is
/// linear in it. Robust by reweighting (Tukey's kernel). `rotation_covariance` is the turn's, which
/// errs for all vectors alike. Refuses fewer than six vectors, a normal that is no unit vector, and
/// points that leave a direction open.
VentralMotion ventral_motion(const std::vector<DerotatedFlow>& flow, const Eigen::Vector3d& normal,
                             const Eigen::Matrix3d& rotation_covariance = Eigen::Matrix3d::Zero());

/// Time until the camera, going on as it does, reaches the plane that `motion` is about.
struct TimeToContact {
  Outcome outcome;
  double seconds = 0;  ///< from the second image on
  double sigma = 0;    ///< [s]
};

/// `dt` is the time between the images [s]. Refuses motion that is not towards the plane beyond
/// three deviations.
TimeToContact time_to_contact(const VentralMotion& motion, const Eigen::Vector3d& normal,
                              double dt);

/// First-order description of the derotated flow around the optical axis (Koenderink & van Doorn
/// 1975), per image pair: flow = centre + gradient * (x, y).
struct AffineFlow {
  Outcome outcome;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  /// Of (centre x, gradient's first row, centre y, its second row), from the flow's and the turn's.
  Matrix6d covariance = Matrix6d::Zero();
  /// Twice the share of the distance that is left behind, where a plane faces the camera.
  double divergence() const { return gradient.trace(); }
  double divergence_variance() const {
    return covariance(1, 1) + covariance(5, 5) + 2 * covariance(1, 5);
  }
};

/// `rotation_covariance` as for `ventral_motion`. Refuses fewer than six vectors and points in a
/// line.
AffineFlow affine_flow(const std::vector<DerotatedFlow>& flow,
                       const Eigen::Matrix3d& rotation_covariance = Eigen::Matrix3d::Zero());

/// How much faster the right half of the view passes than the left one: bees fly in the middle of a
/// corridor by keeping it at zero (Srinivasan et al. 1991).
struct LateralBalance {
  Outcome outcome;
  double left = 0, right = 0;  ///< mean length of the derotated flow on either side of the axis
  double balance = 0;          ///< (right - left) / (right + left), in [-1, 1]
  double sigma = 0;            ///< of `balance`, from the flow's and the turn's
};

/// `rotation_covariance` as for `ventral_motion`. Refuses a side with fewer than three vectors, and
/// flow that is hardly there.
LateralBalance lateral_balance(
    const std::vector<DerotatedFlow>& flow,
    const Eigen::Matrix3d& rotation_covariance = Eigen::Matrix3d::Zero());

}  // namespace placegraph
