#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options for the detection, verification and acceptance of loop closures.
///
/// Lengths are relative to the median depth of the newest keyframe, so that they apply to monocular
/// maps too.
struct LoopOptions {
  bool enabled = true;            ///< detect loop closures
  DetectorOptions detector;       ///< features that describe a keyframe
  PlaceDatabaseOptions database;  ///< retrieval by visual words
  LoopVerifierOptions verifier;   ///< geometric verification of a loop candidate
  /// Minimum number of frames between two keyframes of a loop, unless they are in different
  /// components of the map.
  int min_frame_gap = 40;
  int candidates = 5;  ///< maximum number of keyframes retrieved for one query
  /// Minimum similarity of a candidate, as a share of the similarity of the keyframe before the
  /// query.
  double min_similarity = 0.3;
  /// Assumed drift of the odometry in translation over (median depth + path length since the
  /// match). A loop that contradicts the odometry by more is refused.
  double drift_translation = 0.015;
  /// Assumed drift of the odometry in rotation per median depth of path length, in addition to two
  /// degrees.
  double drift_angle_deg = 1;
  /// Assumed drift of a monocular camera's scale (logarithm) per median depth of path length, in
  /// addition to kMaxLoopScaleError.
  double drift_scale = 0.03;
  void check() const;
};
void visit(OptionVisitor& field, LoopOptions& options);

}  // namespace placegraph
