#pragma once
#include <placegraph/frontend/internal/align/warp.h>
#include <placegraph/graph/image/image.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

/// A pixel of a template. Its place is in the template's coordinates, x = (px - centre) / half, of
/// order one; so is the gradient [grey per unit].
struct TemplateSample {
  Eigen::Vector2d x;
  Eigen::Vector2d gradient;
  double grey;
  int column, row;  ///< on the grid of samples, for the correlation of neighbours
};

/// The samples of one level of the pyramid, in the order of rows.
struct TemplateLevel {
  std::vector<TemplateSample> samples;
  int columns = 0, rows = 0;  ///< of the grid
};

/// A planar region of the reference image, made ready for alignment with any number of images.
class PlanarTemplate {
 public:
  /// `polygon_px`: corners of the region, at least three; `mask`, if not empty, has zeros where
  /// pixels are to be ignored. A level has every pixel of the region or, if they are more than
  /// `max_samples`, those of a coarser grid. Pixels at the image's border have no gradient and are
  /// left out. Throws ArgumentError for an image that is not grey, a mask of another size, or a
  /// polygon of fewer corners or no extent; a region outside the image has no samples.
  PlanarTemplate(const Image& image_ref, const std::vector<Eigen::Vector2d>& polygon_px, int levels,
                 int max_samples, const Image& mask = {});

  const std::vector<TemplateLevel>& levels() const { return levels_; }
  const Eigen::Vector2d& centre_px() const { return centre_px_; }
  double half_px() const { return half_px_; }  ///< half the longer side of the bounding box
  /// The bounding box, clockwise from top left.
  const std::array<Eigen::Vector2d, 4>& corners_px() const { return corners_px_; }
  double diagonal_px() const { return (corners_px_[2] - corners_px_[0]).norm(); }  ///< of that box
  /// From the template's coordinates to pixels of the reference image.
  Eigen::Matrix3d px_from_template() const;

  /// The warp family of 8 degrees of freedom, in this template's coordinates.
  PlanarWarp homography(const Eigen::Matrix3d& H_cur_ref) const {
    return PlanarWarp::homography(H_cur_ref, centre_px_, half_px_);
  }
  /// The largest way a corner goes from one warp to another [px of the current image]; infinite
  /// if either takes a corner beyond the horizon.
  double corner_distance_px(const Eigen::Matrix3d& Ha_cur_ref,
                            const Eigen::Matrix3d& Hb_cur_ref) const;
  /// 8 x dof: how the corners move in the current image [px] per unit of the warp's parameters.
  /// Precondition: the corners are in front of the camera.
  Eigen::Matrix<double, 8, Eigen::Dynamic> corner_jacobian(const PlanarWarp& warp) const;

 private:
  std::vector<TemplateLevel> levels_;
  Eigen::Vector2d centre_px_;
  double half_px_;
  std::array<Eigen::Vector2d, 4> corners_px_;
};

/// The homography that takes the corners of a box, as corners_px() has them, to four others
/// (Heckbert 1989, "Fundamentals of texture mapping and image warping", sec. 2.2.3). Nothing where
/// no camera sees the box so from its front: a corner that is not convex, by a hundredth at least,
/// or all of them in a point.
std::optional<Eigen::Matrix3d> homography_of_box(const std::array<Eigen::Vector2d, 4>& box,
                                                 const std::array<Eigen::Vector2d, 4>& corners);

}  // namespace placegraph
