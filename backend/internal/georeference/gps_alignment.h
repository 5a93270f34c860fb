#pragma once
#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/graph/internal/core/ransac.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <vector>

namespace placegraph {

/// A position in the map and where a fix saw it.
struct PositionPair {
  Eigen::Vector3d map, enu;  ///< [map's unit], [m]
  double sigma_m = 1;        ///< of each coordinate of `enu`
};

enum class AlignmentGroup {
  kPlanar,      ///< rotation about the vertical and translation; heights are left out
  kRigid,       ///< SE(3)
  kSimilarity,  ///< Sim(3)
};

/// Of a map whose nodes are of that kind.
AlignmentGroup alignment_group(PoseKind kind);

struct GpsAlignment {
  Outcome outcome;
  Sim3 T_enu_map;
  std::vector<int> inliers;
  double rmse_m = 0;           ///< of the inliers
  double angle_sigma_deg = 0;  ///< about the direction least determined
};

/// The similarity that puts a map roughly onto its fixes, `pairs` in the order of its way: least
/// squares (Umeyama 1991) inside of MSAC, so that gross errors have no say. It need not be exact,
/// for the map may be bent by drift and is unbent afterwards. Outcomes: kTooFewData below three
/// pairs (two in the plane); kNoConsensus if fewer than half of the pairs agree; kDegenerate if the
/// positions lie on a line or point, so that a rotation stays open.
[[nodiscard]] GpsAlignment align_to_fixes(const std::vector<PositionPair>& pairs,
                                          AlignmentGroup group, const GpsAlignmentOptions& options,
                                          Random& random);

}  // namespace placegraph
