#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct LoopOptions {
  bool enabled = true;
  DetectorOptions detector;
  PlaceDatabaseOptions database;
  LoopVerifierOptions verifier;
  int min_frame_gap = 40;  ///< nearer views are neighbours, not revisits
  int candidates = 5;      ///< retrieved views that are verified
  double min_similarity =
      0.3;                 ///< of a candidate, as a share of the similarity to the last keyframe
  int support_window = 4;  ///< keyframes within which a second loop must agree
  double support_translation =
      0.03;  ///< disagreement of two loops / (median depth + path length between)
  double support_angle_deg = 2;
  double drift_translation =
      0.015;                   ///< of the odometry / (median depth + path length since the match)
  double drift_angle_deg = 1;  ///< of the odometry, per median depth of path length
  double drift_scale =
      0.03;  ///< of the scale of one camera (logarithm), per median depth of path length
  double information_scale = 0.1;  ///< feature noise is correlated: information counts this much
  void check() const;
};
void visit(OptionVisitor& field, LoopOptions& options);

}  // namespace placegraph
