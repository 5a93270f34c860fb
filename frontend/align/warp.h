#pragma once
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/graph/geometry/se2.h>

#include <optional>

namespace placegraph {

/// Exponential of a traceless 3x3 matrix, a homography of determinant one, by scaling and squaring.
Eigen::Matrix3d sl3_exp(const Eigen::Matrix3d& A);

/// Motion of a planar template between the reference and the current image.
///
/// One of three families of homographies H_cur_ref (px_cur ~ H px_ref), each with its own
/// parameters, all with one interface. `plus` perturbs on the right, so a step x moves the template
/// within the reference image first. Optimizers need only the generators A_k = H^-1 dH/dx_k at
/// x = 0 of a family (Benhimane & Malis 2007, 3.2): the pixel p of the reference moves by the
/// projective field of A_k at p.
class PlanarWarp {
 public:
  enum class Kind {
    kHomography,    ///< 8 degrees of freedom: H exp(sum x_k A_k), A_k a basis of sl(3)
    kRigidMotion,   ///< 6: T_cur_ref exp(x) of a camera before a known plane (distance 1)
    kPlanarMotion,  ///< 3: the camera moves along a known plane, its height and tilt constant
  };
  static constexpr int kMaxDof = 8;
  using Step = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxDof, 1>;
  using Generators = Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, kMaxDof>;

  PlanarWarp() = default;  ///< the identity, parameters in pixels
  /// Warp of 8 degrees of freedom.
  ///
  /// The parameters are those of coordinates (px - centre) / half, of order one for a template with
  /// that centre and half size. Throws ArgumentError if H is singular or half_px not positive.
  static PlanarWarp homography(const Eigen::Matrix3d& H_cur_ref, const Eigen::Vector2d& centre_px,
                               double half_px);
  static PlanarWarp rigid_motion(const Eigen::Matrix3d& K, const SE3& T_cur_ref,
                                 const Plane& plane_ref);
  /// Warp of a motion along a plane, `T_cur_ref` in the plane's axes.
  ///
  /// The axes are forward (the camera's z axis along the plane, else its x) and n x forward; the
  /// angle is about n.
  static PlanarWarp planar_motion(const Eigen::Matrix3d& K, const SE2& T_cur_ref,
                                  const Plane& plane_ref);

  Kind kind() const { return kind_; }
  int dof() const { return kind_ == Kind::kHomography ? 8 : kind_ == Kind::kRigidMotion ? 6 : 3; }
  const Eigen::Matrix3d& H_cur_ref() const { return H_; }
  PlanarWarp plus(const Step& x) const;
  /// The member of this family that is close to a homography.
  ///
  /// kHomography: the homography; kRigidMotion: the motion before the plane
  /// (motion_from_homography); kPlanarMotion: the part of that motion along the plane. Throws
  /// ArgumentError if H is singular.
  PlanarWarp at(const Eigen::Matrix3d& H_cur_ref) const;
  /// Generators (9 x dof), each column the rows of A_k, up to a multiple of the identity.
  Generators generators() const;
  /// Derivative (2 x dof) of a reference pixel's image [px of the current image] by the parameters.
  ///
  /// Precondition: the pixel's point is in front of the camera.
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMaxDof> pixel_jacobian(
      const Eigen::Vector2d& px_ref) const;

  /// The rigid motion in the scale of the plane's distance; nothing for kHomography.
  std::optional<SE3> T_cur_ref() const;
  /// The motion along the plane; nothing for the other two families.
  std::optional<SE2> planar_T_cur_ref() const;

 private:
  void compose();  ///< H from the motion

  Kind kind_ = Kind::kHomography;
  Eigen::Matrix3d H_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();  ///< K; homography: normalized -> pixel
  Plane plane_ref_;
  SO3 R_ref_plane_;
  SE2 planar_;
  SE3 rigid_;
};

/// The pixel to which a homography maps `px`; nothing if it is on or beyond the horizon.
std::optional<Eigen::Vector2d> map_pixel(const Eigen::Matrix3d& H, const Eigen::Vector2d& px);

}  // namespace placegraph
