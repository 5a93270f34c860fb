#pragma once
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/graph/core/outcome.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// "none", "origin", "se3", "sim3", "scale": the spelling of the command line and of results.
std::string to_string(Alignment alignment);

/// A similarity that takes estimated positions to true ones: p_truth = scale R p_estimate + t.
struct AlignmentResult {
  Outcome outcome;
  double scale = 1;
  Eigen::Matrix3d R_truth_estimate = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_truth_estimate = Eigen::Vector3d::Zero();  ///< [m]
  double rmse_m = 0;                                           ///< of the positions after alignment
  int pairs = 0;                                               ///< used for the fit
  /// Directions the positions spread in, 0 to 3. With 1 (a straight line) the rotation about the
  /// line is free: the outcome is kDegenerate, though the similarity is one of the best and
  /// `rmse_m` is the unique minimum.
  int rank = 0;

  /// A pose of the estimate in the frame of the ground truth.
  Eigen::Isometry3d apply(const Eigen::Isometry3d& T_world_estimate) const;
};

/// Least-squares similarity from `points_from` to `points_to`, Nx3 [m] (Umeyama 1991, eq. 34-43);
/// scale stays 1 unless `with_scale`. Outcomes: kTooFewData below three points; kDegenerate if the
/// points coincide (nothing fitted) or lie on a line (see `rank`). Throws ArgumentError if the
/// sizes differ.
[[nodiscard]] AlignmentResult umeyama(const std::vector<Eigen::Vector3d>& points_from,
                                      const std::vector<Eigen::Vector3d>& points_to,
                                      bool with_scale);

/// The alignment of the given kind over all pairs that have an estimate. Outcomes: kTooFewData (no
/// pair; fewer than three for kSe3 and kSim3, than two for kScale); kDegenerate as umeyama, and if
/// the estimate never moves for kScale, or the fitted scale is not positive.
[[nodiscard]] AlignmentResult align(const std::vector<FramePair>& pairs, Alignment alignment);

}  // namespace placegraph
