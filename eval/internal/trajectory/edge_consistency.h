#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <vector>

namespace placegraph {

/// Errors of measured relative poses relative to their stated covariances.
struct EdgeConsistency {
  int edges = 0;    ///< judged edges
  int unknown = 0;  ///< edges without the true pose of an end, not judged
  /// Normalized estimation error squared of an edge per degree of freedom, e^T information e / 6
  /// with e = Log(T_from_to^-1 T_from_to_true): mean and median. The mean is 1 if the stated
  /// covariances are right (Bar-Shalom, Li and Kirubarajan 2001, 5.4.2), and larger if they are too
  /// small.
  double mean_nees = 0, median_nees = 0;
  /// Share of edges with an error beyond 99 % of the stated distribution.
  double share_beyond_99 = 0;
};

/// Compares edges with the true poses `T_world_node`, by node id. Nothing is fitted: only relative
/// poses are compared. Throws ArgumentError for edges that are not over SE(3).
EdgeConsistency edge_consistency(const std::vector<RelativePoseConstraint>& edges,
                                 const std::map<NodeId, SE3>& T_world_node);

}  // namespace placegraph
