#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace placegraph {

/// Where the pixels of an image are seen in other views of the same camera, by their inverse
/// depths, and the inverse depths that a sweep tries.
struct SweepGeometry {
  /// What has less depth in a view, as a share of its depth in the image, is not seen there.
  static constexpr double kBehind = 0.01;

  struct View {
    Eigen::Matrix3d turn;  ///< pixels of the image to those of the view, of what is far away
    Eigen::Vector3d move;  ///< change of them with inverse depth [m]

    /// Homogeneous pixel of the view; its last part is the depth there over that in the image.
    Eigen::Vector3d at(double u, double v, double inverse_depth) const {
      return turn * Eigen::Vector3d(u, v, 1) + inverse_depth * move;
    }
    /// Pixels that a change of inverse depth moves the point by [px m].
    double rate(double u, double v, double inverse_depth) const {
      const Eigen::Vector3d p = at(u, v, inverse_depth);
      return (move.head<2>() - p.head<2>() * (move[2] / p[2])).norm() / std::abs(p[2]);
    }
    /// Takes the image to the view, of a plane that faces the camera.
    Eigen::Matrix3d homography(double inverse_depth) const {
      Eigen::Matrix3d H = turn;
      H.col(2) += inverse_depth * move;
      return H;
    }
  };

  Camera camera;
  std::vector<View> views{};
  double farthest = 0;  ///< inverse depth of level 0
  double step = 0;      ///< of inverse depth between levels
  int levels = 0;       ///< 0 where no view moves

  double inverse_depth(double level) const { return farthest + level * step; }
  /// How many views are the better half of them.
  std::size_t better_half() const { return (views.size() + 1) / 2; }
};

/// Which depths are tried.
struct SweepRange {
  double min_depth_m, max_depth_m;
  double step_px;  ///< between two levels, where a view moves most
  int max_levels;  ///< farther apart where more would be needed
};

/// Of views from `T_view_cam`. Levels are so far apart that no view moves by more than `step_px`
/// between two of them where it moves most, as long as they are not too many.
[[nodiscard]] SweepGeometry sweep_geometry(const Camera& camera, const std::vector<SE3>& T_view_cam,
                                           const SweepRange& range);

}  // namespace placegraph
