#pragma once
#include <placegraph/graph/core/outcome.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A similarity from estimated to true positions: p_truth = scale R p_estimate + t.
struct AlignmentResult {
  Outcome outcome;   ///< see umeyama and align
  double scale = 1;  ///< metres of the truth per unit of the estimate
  Eigen::Matrix3d R_truth_estimate = Eigen::Matrix3d::Identity();  ///< its rotation
  Eigen::Vector3d t_truth_estimate = Eigen::Vector3d::Zero();      ///< [m]
  double rmse_m = 0;  ///< RMSE of the positions of the fit after alignment [m]
  int pairs = 0;      ///< number of pairs in the fit
  /// Number of directions of the spread of the positions, 0 to 3. With 1 (a straight line) the
  /// rotation about the line is unobservable: the outcome is kDegenerate, although the similarity
  /// is one of the optimal ones and `rmse_m` is the unique minimum.
  int rank = 0;
  /// Axes, in the truth's world, about which the rotation is not determined by the positions beyond
  /// their errors; none or one.
  std::vector<Eigen::Vector3d> free_axes;
  bool mirrored = false;  ///< a reflection would at least halve the error
  double explained = 1;   ///< share of the true positions' variance that a fitted scale explains
  std::string vertical;   ///< the vertical that was used, for kYaw
  std::vector<std::string> doubts;  ///< what the positions do not determine, a line each

  /// Transforms a pose of the estimate into the coordinate frame of the ground truth.
  Eigen::Isometry3d apply(const Eigen::Isometry3d& T_world_estimate) const;
};

/// Fits the least-squares similarity from `points_from` to `points_to` [m] (Umeyama 1991).
///
/// Equations 34 to 43; scale stays 1 unless `with_scale`. Points that fit at least as well where
/// they are, as equal ones do but for rounding, stay there: the identity to the bit. Outcomes:
/// kTooFewData below three points; kDegenerate if the points coincide (nothing fitted) or are on a
/// line (see `rank`). Throws ArgumentError if the sizes differ.
[[nodiscard]] AlignmentResult umeyama(const std::vector<Eigen::Vector3d>& points_from,
                                      const std::vector<Eigen::Vector3d>& points_to,
                                      bool with_scale);

}  // namespace placegraph
