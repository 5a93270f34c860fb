#pragma once
#include <placegraph/frontend/internal/planes/homography.h>
#include <placegraph/graph/geometry/se2.h>

#include <optional>

namespace placegraph {

/// exp of a traceless 3x3 matrix, by scaling and squaring: a homography of determinant one.
Eigen::Matrix3d sl3_exp(const Eigen::Matrix3d& A);

/// How a planar template moves between the reference and the current image: one of three families
/// of homographies H_cur_ref (px_cur ~ H px_ref), each with its own parameters, all with one
/// interface. `plus` perturbs on the right, so a step x moves the template within the reference
/// image first. Optimizers need of a family no more than the generators A_k = H^-1 dH/dx_k at x = 0
/// (Benhimane & Malis 2007, 3.2): the pixel p of the reference moves by the projective field of A_k
/// at p.
class PlanarWarp {
 public:
  enum class Kind {
    kHomography,    ///< 8 degrees of freedom: H exp(sum x_k A_k), A_k a basis of sl(3)
    kRigidMotion,   ///< 6: T_cur_ref exp(x) of a camera before a known plane (distance = unit)
    kPlanarMotion,  ///< 3: the camera glides over a known plane, its height and tilt kept
  };
  static constexpr int kMaxDof = 8;
  using Step = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxDof, 1>;
  using Generators = Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, kMaxDof>;

  PlanarWarp() = default;  ///< the identity, parameters in pixels
  /// The parameters are those of coordinates (px - centre) / half: of order one for a template of
  /// that place and half size. Throws ArgumentError if H is singular or half_px not positive.
  static PlanarWarp homography(const Eigen::Matrix3d& H_cur_ref, const Eigen::Vector2d& centre_px,
                               double half_px);
  static PlanarWarp rigid_motion(const Eigen::Matrix3d& K, const SE3& T_cur_ref,
                                 const Plane& plane_ref);
  /// `T_cur_ref` in the plane's axes: forward (the camera's z axis along the plane, else its x),
  /// n x forward, angle about n.
  static PlanarWarp planar_motion(const Eigen::Matrix3d& K, const SE2& T_cur_ref,
                                  const Plane& plane_ref);

  Kind kind() const { return kind_; }
  int dof() const { return kind_ == Kind::kHomography ? 8 : kind_ == Kind::kRigidMotion ? 6 : 3; }
  const Eigen::Matrix3d& H_cur_ref() const { return H_; }
  PlanarWarp plus(const Step& x) const;
  /// The member of this family that comes close to a homography: itself; the motion that it fits
  /// before the plane (motion_from_homography); of that motion what is along the plane. Throws
  /// ArgumentError if H is singular.
  PlanarWarp at(const Eigen::Matrix3d& H_cur_ref) const;
  /// 9 x dof, the rows of each A_k one after the other; a multiple of the identity may be in it.
  Generators generators() const;
  /// 2 x dof: how the image of a pixel of the reference moves [px of the current image] per unit of
  /// the parameters. Precondition: it is in front of the camera.
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMaxDof> pixel_jacobian(
      const Eigen::Vector2d& px_ref) const;

  /// The rigid motion, in the unit of the plane's distance; nothing for a bare homography.
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

/// The pixel to which a homography maps another; nothing if it lies on or beyond the horizon.
std::optional<Eigen::Vector2d> map_pixel(const Eigen::Matrix3d& H, const Eigen::Vector2d& px);

}  // namespace placegraph
