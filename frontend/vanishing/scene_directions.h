#pragma once
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/so3.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Direction of edges in the scene.
struct VanishingPoint {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector, camera frame, z >= 0
  /// Covariance of the direction; zero along it.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  int segments = 0;     ///< number of segments that point there
  double evidence = 0;  ///< increase of the description length without it [nats]
};

/// Vanishing points of an image, see find_vanishing_points.
struct VanishingPoints {
  Outcome outcome;                     ///< too few data, no consensus
  std::vector<VanishingPoint> points;  ///< points, most evidence first
  std::vector<int> labels;             ///< label of each segment, an index into points or -1
  VanishingNoise noise;                ///< estimated noise
};

/// Three orthogonal directions of edges of the scene, in the camera frame.
struct ManhattanFrame {
  /// Too few data, no consensus (no two orthogonal directions have enough segments), degenerate
  /// (tracked: no direction has enough segments).
  Outcome outcome;
  /// Maps coordinates along the axes into the camera: its columns are the axes. Any of the 24
  /// frames along the same axes is equivalent; this is the one nearest to the prediction, otherwise
  /// to the camera's own axes.
  SO3 R_cam_manhattan;
  /// Information about a perturbation on the right [1 / rad^2]: rank two with only one axis.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Inverse of the information [rad^2]; zero if `rank` is below three.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  int rank = 0;                      ///< rank of the information
  std::vector<int> axis;             ///< axis of each segment: 0, 1, 2 or -1
  std::array<int, 3> segments{};     ///< number of segments of each axis
  std::array<double, 3> evidence{};  ///< evidence of each axis [nats]
  double orthogonality_deg = 0;      ///< estimated deviation of the axes from right angles
  double log_odds = 0;  ///< log odds that the axes are orthogonal, from the angles between them
};

/// Relation of a vanishing point to the Manhattan frames of its scene.
struct PointRole {
  int frame = -1, axis = -1;  ///< frame and axis that it is; -1: none
  /// Frame and axis to which a point that is not an axis is orthogonal, as all level directions are
  /// to the upright one (Atlanta worlds), and slopes of a roof to the ridge.
  int across_frame = -1, across_axis = -1;
};

/// Directions of a scene from the segments of one image.
struct SceneDirections {
  VanishingPoints vanishing;
  std::vector<PointRole> roles;        ///< role of each of vanishing.points
  std::vector<ManhattanFrame> frames;  ///< most evident first; empty if none is supported
};

/// Estimates vanishing points and Manhattan frames together.
///
/// A vanishing point that is an axis of a frame is constrained to it with the accuracy of the
/// frame's right angles; an axis with enough segments, but too few to be found without the others,
/// is a vanishing point too. Deterministic for a given `random`. Outcome and errors are those of
/// find_vanishing_points.
[[nodiscard]] SceneDirections find_scene_directions(const std::vector<LineSegment>& segments,
                                                    const Camera& camera,
                                                    const SceneDirectionOptions& options,
                                                    Random& random);

}  // namespace placegraph
