#pragma once
#include <placegraph/backend/robust/loop_pairs.h>
#include <placegraph/backend/robust/robust_options.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

/// The mixture of true and false rings of neighbouring loops, estimated from all rings.
struct RingMixture {
  double noise_scale = 1;           ///< variance of the noise relative to the information
  bool scale_is_known = false;      ///< false: too few rings close to estimate it
  std::vector<double> probability;  ///< probability that a ring closes, in the order of the pairs
};

/// Fits a mixture to the misclosures e of rings by expectation maximization.
/// Its components are: both loops are true and e ~ N(0, noise_scale * covariance); or they are
/// confused, i.e. false but not random (the same motion at two places), with noise at least a
/// hundred times larger; or e is uniform over `volume`, the volume in which a loop may be found
/// (translation x rotation (x log scale)). `dof` is the dimension of e. The likeliest fit from
/// several initial scales is used. If too few rings close, the scale is estimated from the rings
/// that single loops close with the odometry (`drift`), of which four are needed; else it is
/// unknown, with the value 1. A common factor of all information only multiplies noise_scale.
RingMixture fit_rings(const std::vector<LoopPair>& pairs, const std::vector<RingMisclosure>& drift,
                      int dof, double volume);

/// Mutual support of the loops of a graph over the short odometry between them.
/// True loops form groups that agree closely; random false loops do not.
struct LoopSupport {
  double noise_scale = 1;
  bool scale_is_known = false;  ///< false: too few loops to estimate the scale of the noise
  /// Loops that support each other, directly or through others, as positions in PackedGraph::edges;
  /// the largest group is first. A loop without support is a group of one. Copies of loops and
  /// edges that repeat one step of the odometry are last, each in its own group: copies agree
  /// without being true.
  std::vector<std::vector<int>> clusters;
  int alone = 0;              ///< number of loops without support, except copies, repeated steps
  std::size_t loops() const;  ///< number of loops in all clusters
};

template <class Group>
LoopSupport support_loops(const PackedGraph<Group>& graph, const OdometryChain<Group>& chain,
                          const LoopSupportOptions& options);

}  // namespace placegraph
