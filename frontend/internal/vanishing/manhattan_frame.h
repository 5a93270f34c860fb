#pragma once
#include <placegraph/frontend/internal/vanishing/vanishing_points.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/geometry/so3.h>

#include <array>
#include <vector>

namespace placegraph {

/// Three directions at right angles along which edges of the scene lie, as the camera sees them.
struct ManhattanFrame {
  /// Too few data, no consensus (no two directions at right angles are shown by enough segments),
  /// degenerate (tracked: the segments show no direction).
  Outcome outcome;
  /// Maps coordinates along the axes into the camera: its columns are the axes. Any of the 24
  /// frames along the same axes would do; this is the one nearest to the prediction, else to the
  /// camera's own axes.
  SO3 R_cam_manhattan;
  /// About a perturbation on the right [1 / rad^2]: of rank two where only one axis is seen.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Its inverse [rad^2]; zero where `rank` is below three.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  int rank = 0;                      ///< of the information
  std::vector<int> axis;             ///< per segment: 0, 1, 2 or -1
  std::array<int, 3> segments{};     ///< of each axis
  std::array<double, 3> evidence{};  ///< of each axis [nats]
  double orthogonality_deg = 0;      ///< deviation of the axes from right angles, as estimated
  double log_odds = 0;  ///< by the angles between the axes, that they are at right ones
};

/// The rectangular worlds that the segments of evidence show, most evident first; none if no two
/// directions at right angles are shown by enough of them. Candidates: two vanishing points at
/// right angles, or one and a segment that passes through another (METHODS: three-line minimal
/// sets); each is refined on SO(3) by reweighted Gauss-Newton over all segments that its axes win,
/// the axes' own deviations from right angles integrated out with a variance of largest likelihood.
/// A further world must have an axis that no world before it has. `axis` is per line of the
/// evidence.
[[nodiscard]] std::vector<ManhattanFrame> find_manhattan_frames(const VanishingEvidence& evidence,
                                                                const VanishingPoints& points,
                                                                const ManhattanOptions& options);

/// The most evident rectangular world of an image's segments. Errors are VanishingEvidence's.
[[nodiscard]] ManhattanFrame estimate_manhattan_frame(const std::vector<LineSegment>& segments,
                                                      const Camera& camera,
                                                      const VanishingPointOptions& points,
                                                      const ManhattanOptions& options,
                                                      Random& random);

/// The frame near a predicted one, known to `sigma_rad` about every axis. The prediction says where
/// to look and does not enter the information: what the segments leave open stays as predicted and
/// has none. Errors are VanishingEvidence's.
[[nodiscard]] ManhattanFrame track_manhattan_frame(const std::vector<LineSegment>& segments,
                                                   const Camera& camera,
                                                   const SO3& R_cam_manhattan_predicted,
                                                   double sigma_rad, const VanishingNoise& noise,
                                                   const ManhattanOptions& options);

/// Of the 24 frames along the same axes the one nearest to `like`.
SO3 nearest_axes(const SO3& R_cam_manhattan, const SO3& like);

}  // namespace placegraph
