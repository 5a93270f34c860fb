#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <vector>

namespace placegraph {

/// How far measured relative poses lie from the true ones, in the deviations they claim.
struct EdgeConsistency {
  int edges = 0;    ///< judged
  int unknown = 0;  ///< not judged: the truth of an end is not known
  /// Normalized estimation error squared of an edge per degree of freedom, e^T information e / 6
  /// with e = Log(T_from_to^-1 T_from_to_true): mean and median. The mean is 1 where claims are
  /// right (Bar-Shalom, Li and Kirubarajan 2001, 5.4.2), more where they are too bold.
  double mean_nees = 0, median_nees = 0;
  double share_beyond_99 = 0;  ///< of the edges whose error a right claim would exclude at 99 %
};

/// `T_world_node`: true poses by node id. Nothing is fitted: only relative poses count. Throws
/// ArgumentError for edges that are not over SE(3).
EdgeConsistency edge_consistency(const std::vector<RelativePoseConstraint>& edges,
                                 const std::map<NodeId, SE3>& T_world_node);

}  // namespace placegraph
