#pragma once
#include <placegraph/backend/internal/robust/loop_pairs.h>
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

/// How rings of neighbouring loops close, told from all of them together.
struct RingMixture {
  double noise_scale = 1;       ///< variance of the noise in units of what the information claims
  bool scale_is_known = false;  ///< false: too few rings close to tell
  std::vector<double> probability;  ///< that a ring closes, in the order of the pairs
};

/// Fits a mixture to the misclosures e of rings (expectation maximization): both loops are true and
/// e ~ N(0, noise_scale * covariance); or they are confused, false but not at random (the same
/// motion at two places), with noise at least a hundred times larger; or e is uniform over
/// `volume`, that of the places where a loop may be found (translation x rotation (x log scale)).
/// `dof` is the dimension of e. From several starting scales the likeliest fit is taken. Where too
/// few rings close to tell, those that single loops close with the odometry (`drift`) give the
/// scale, if there are four; else it is not known, and 1. A common factor of all information only
/// multiplies noise_scale.
RingMixture fit_rings(const std::vector<LoopPair>& pairs, const std::vector<RingMisclosure>& drift,
                      int dof, double volume);

/// What the loops of a graph say of each other over the short stretches of odometry between them.
/// True loops come in groups that agree closely; random false ones do not.
struct LoopSupport {
  double noise_scale = 1;
  bool scale_is_known = false;  ///< false: there are too few loops to know the noise's scale
  /// Loops that support each other, directly or through others, as positions in
  /// PackedGraph::edges; the largest first. A loop without support is alone. Edges that repeat one
  /// step of the odometry come last, each by itself: copies of odometry agree without being true.
  std::vector<std::vector<int>> clusters;
  int alone = 0;              ///< loops without support, repeated steps apart
  std::size_t loops() const;  ///< in all clusters
};

template <class Group>
LoopSupport support_loops(const PackedGraph<Group>& graph, const OdometryChain<Group>& chain,
                          const LoopSupportOptions& options);

}  // namespace placegraph
