#pragma once
#include <placegraph/frontend/align/warp.h>
#include <placegraph/graph/image/image.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

/// A pixel of a template.
///
/// Its position is in the template's coordinates, x = (px - centre) / half, of order one; so is
/// the gradient [grey per unit].
struct TemplateSample {
  Eigen::Vector2d x;
  Eigen::Vector2d gradient;
  double grey;
  int column, row;  ///< on the grid of samples, for the correlation of neighbours
};

/// The samples of one level of the pyramid, row by row.
struct TemplateLevel {
  std::vector<TemplateSample> samples;
  int columns = 0, rows = 0;  ///< size of the grid
};

/// A planar region of the reference image, prepared for alignment with other images.
class PlanarTemplate {
 public:
  /// Takes the template from the region `polygon_px` (at least three corners) of an image.
  ///
  /// `mask`, if not empty, has zeros where pixels are ignored. A level has every pixel of the
  /// region or, if there are more than `max_samples`, those of a coarser grid. Pixels at the
  /// image's border have no gradient and are left out. A region outside the image has no samples.
  /// Throws ArgumentError for an image that is not grey, a mask of another size, or a polygon with
  /// fewer corners or no extent.
  PlanarTemplate(const Image& image_ref, const std::vector<Eigen::Vector2d>& polygon_px, int levels,
                 int max_samples, const Image& mask = {});

  const std::vector<TemplateLevel>& levels() const { return levels_; }
  const Eigen::Vector2d& centre_px() const { return centre_px_; }
  double half_px() const { return half_px_; }  ///< half the longer side of the bounding box
  /// The bounding box, clockwise from top left.
  const std::array<Eigen::Vector2d, 4>& corners_px() const { return corners_px_; }
  double diagonal_px() const {
    return (corners_px_[2] - corners_px_[0]).norm();
  }  ///< diagonal of the bounding box
  /// From the template's coordinates to pixels of the reference image.
  Eigen::Matrix3d px_from_template() const;

  /// The warp family of 8 degrees of freedom, in this template's coordinates.
  PlanarWarp homography(const Eigen::Matrix3d& H_cur_ref) const {
    return PlanarWarp::homography(H_cur_ref, centre_px_, half_px_);
  }
  /// Largest distance between the images of a corner under two warps [px of the current image].
  ///
  /// Infinite if either warp maps a corner beyond the horizon.
  double corner_distance_px(const Eigen::Matrix3d& Ha_cur_ref,
                            const Eigen::Matrix3d& Hb_cur_ref) const;
  /// Derivative (8 x dof) of the corners in the current image [px] by the warp's parameters.
  ///
  /// Precondition: the corners are in front of the camera.
  Eigen::Matrix<double, 8, Eigen::Dynamic> corner_jacobian(const PlanarWarp& warp) const;

 private:
  std::vector<TemplateLevel> levels_;
  Eigen::Vector2d centre_px_;
  double half_px_;
  std::array<Eigen::Vector2d, 4> corners_px_;
};

/// Homography that maps the corners of a box, in the order of corners_px(), to four others.
///
/// After Heckbert 1989, "Fundamentals of texture mapping and image warping", sec. 2.2.3. Nothing if
/// no camera can see the box so from its front: a corner is not convex, by a hundredth at least, or
/// all corners coincide.
std::optional<Eigen::Matrix3d> homography_of_box(const std::array<Eigen::Vector2d, 4>& box,
                                                 const std::array<Eigen::Vector2d, 4>& corners);

}  // namespace placegraph
