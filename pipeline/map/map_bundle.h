#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <cstddef>
#include <vector>

namespace placegraph {

/// Settings of adjust_map.
struct MapBundleOptions {
  double kernel_px = 1;     ///< width of Cauchy's kernel of the reprojection errors
  double max_error_px = 4;  ///< largest reprojection error of an observation that is kept
  int max_iterations = 40;  ///< steps of Levenberg-Marquardt of each round at most
};

/// Keyframes and landmarks of a map after a bundle adjustment of their observations.
struct MapBundle {
  /// An observation that was kept.
  struct Observation {
    Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< in the undistorted image
    int point = 0;                                 ///< position in `points`
  };
  /// A keyframe with its observations.
  struct View {
    const Keyframe* keyframe = nullptr;     ///< keyframe of the map
    SE3 T_map_cam;                          ///< adjusted pose
    std::vector<Observation> observations;  ///< ascending by landmark; may be empty
  };
  /// A landmark with at least two observations.
  struct Point {
    PlacedLandmark landmark;  ///< the landmark with its adjusted position
    int views = 0;            ///< number of its observations
    double error_px = 0;      ///< mean reprojection error of its observations
  };
  Outcome outcome;             ///< outcome, see adjust_map
  std::vector<View> views;     ///< every keyframe of the component
  std::vector<Point> points;   ///< points, in the order of the map
  std::size_t offered = 0;     ///< observations of landmarks of the component
  std::size_t kept = 0;        ///< observations of `points`
  double error_before_px = 0;  ///< mean reprojection error of all that can be projected, at first
  double error_px = 0;         ///< mean reprojection error of those that were kept
};

/// Bundle adjustment of all keyframes and landmarks of one component of a map.
/// It minimizes the reprojection errors in the (left) camera. The first keyframe is fixed; the
/// relative poses of consecutive keyframes enter with a standard deviation of a twentieth of their
/// distance and half a degree, so that the map's scale and what no observation determines are kept.
/// Observations whose error exceeds the largest one are left out, then points with fewer than two.
/// `camera` is that of the undistorted images. Throws ArgumentError as Map::components.
/// kTooFewData: no landmark has two observations that agree with it.
[[nodiscard]] MapBundle adjust_map(const Map& map, int component, const Camera& camera,
                                   const MapBundleOptions& options = {});

}  // namespace placegraph
