#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// How loop closures are found, verified and tested before they are accepted.
///
/// Lengths are relative to the median depth of the newest keyframe, so that they hold for
/// monocular maps too.
struct LoopOptions {
  bool enabled = true;            ///< look for loop closures
  DetectorOptions detector;       ///< features that describe a keyframe
  PlaceDatabaseOptions database;  ///< retrieval by visual words
  LoopVerifierOptions verifier;   ///< geometric verification of a candidate
  int min_frame_gap = 40;         ///< frames between two keyframes that may form a loop, at least
  int candidates = 5;             ///< most keyframes retrieved for one query
  /// Least similarity of a candidate, as a share of that of the keyframe before the query.
  double min_similarity = 0.3;
  int support_window = 4;  ///< keyframes within which a second loop must agree
  /// Largest disagreement of two loops in translation over (median depth + path length between
  /// them).
  double support_translation = 0.03;
  double support_angle_deg = 2;  ///< largest disagreement of two loops in rotation
  /// Assumed drift of the odometry in translation over (median depth + path length since the
  /// match): a loop that contradicts the odometry by more is refused.
  double drift_translation = 0.015;
  /// Assumed drift of the odometry in rotation per median depth of path length, beside
  /// support_angle_deg.
  double drift_angle_deg = 1;
  /// Assumed drift of a monocular camera's scale (logarithm) per median depth of path length,
  /// beside verifier.max_scale_error.
  double drift_scale = 0.03;
  /// Factor on the information of a loop: feature noise is correlated, so that it tells less than
  /// the number of its inliers promises.
  double information_scale = 0.1;
  void check() const;
};
void visit(OptionVisitor& field, LoopOptions& options);

}  // namespace placegraph
