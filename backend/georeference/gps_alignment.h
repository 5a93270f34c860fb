#pragma once
#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/graph/core/ransac.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <vector>

namespace placegraph {

/// A position in the map and its measurement by a fix.
struct PositionPair {
  Eigen::Vector3d map, enu;  ///< in the map's scale; in metres
  double sigma_m = 1;        ///< standard deviation of each coordinate of `enu`
};

enum class AlignmentGroup {
  kPlanar,      ///< rotation about the vertical and translation; heights are left out
  kRigid,       ///< SE(3)
  kSimilarity,  ///< Sim(3)
};

/// The alignment group of a map whose nodes are of that kind.
AlignmentGroup alignment_group(PoseKind kind);

struct GpsAlignment {
  Outcome outcome;
  Sim3 T_enu_map;
  std::vector<int> inliers;
  double rmse_m = 0;           ///< RMS error of the inliers [m]
  double angle_sigma_deg = 0;  ///< standard deviation about the least determined axis
};

/// Estimates a similarity that aligns a map approximately to its fixes.
/// `pairs` are in the order of the path. Least squares (Umeyama 1991) within MSAC, which is robust
/// against gross errors. The result need not be exact, because the map may be deformed by drift,
/// which is corrected afterwards. Outcomes: kTooFewData below three pairs (two in the plane);
/// kNoConsensus if fewer than half of the pairs agree; kDegenerate if the positions are on a line
/// or point, which leaves a rotation undetermined.
[[nodiscard]] GpsAlignment align_to_fixes(const std::vector<PositionPair>& pairs,
                                          AlignmentGroup group, const GpsAlignmentOptions& options,
                                          Random& random);

}  // namespace placegraph
