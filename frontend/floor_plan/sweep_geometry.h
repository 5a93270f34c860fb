#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace placegraph {

/// Projections of an image's pixels into other views of the same camera, by inverse depth, and the
/// inverse depths of a sweep.
struct SweepGeometry {
  /// Points with less depth in a view than this share of their depth in the image count as not
  /// visible.
  static constexpr double kBehind = 0.01;

  struct View {
    Eigen::Matrix3d H_infinity;  ///< homography from the image to the view of points at infinity
    Eigen::Vector3d move;        ///< derivative of the pixel by the inverse depth [m]

    /// Homogeneous pixel in the view; its last part is the depth there over that in the image.
    Eigen::Vector3d at(double u, double v, double inverse_depth) const {
      return H_infinity * Eigen::Vector3d(u, v, 1) + inverse_depth * move;
    }
    /// Displacement of the point in the view per change of inverse depth [px m].
    double rate(double u, double v, double inverse_depth) const {
      const Eigen::Vector3d p = at(u, v, inverse_depth);
      return (move.head<2>() - p.head<2>() * (move[2] / p[2])).norm() / std::abs(p[2]);
    }
    /// Homography from the image to the view, for a plane that faces the camera.
    Eigen::Matrix3d homography(double inverse_depth) const {
      Eigen::Matrix3d H = H_infinity;
      H.col(2) += inverse_depth * move;
      return H;
    }
  };

  Camera camera;
  std::vector<View> views{};
  double farthest = 0;  ///< inverse depth of level 0
  double step = 0;      ///< difference of inverse depth between levels
  int levels = 0;       ///< number of levels; 0 if no view moves

  double inverse_depth(double level) const { return farthest + level * step; }
  /// Number of views in the better half.
  std::size_t better_half() const { return (views.size() + 1) / 2; }
};

/// Range of the depths searched.
struct SweepRange {
  double min_depth_m, max_depth_m;
  double step_px;  ///< displacement between two levels, in the view that moves most
  int max_levels;  ///< largest number of levels; their spacing grows if more would be needed
};

/// Computes the geometry for views at `T_view_cam`. The displacement between two levels in any view
/// is at most `step_px` where it is largest, unless the number of levels is limited.
[[nodiscard]] SweepGeometry sweep_geometry(const Camera& camera, const std::vector<SE3>& T_view_cam,
                                           const SweepRange& range);

}  // namespace placegraph
