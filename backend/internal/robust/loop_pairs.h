#pragma once
#include <placegraph/backend/internal/solver/odometry_chain.h>

namespace placegraph {

/// A loop as the odometry sees it: W = T_first_from * T_from_to (measured) * T_first_to^-1 would be
/// the identity without drift. Two loops a, b between the same runs close a ring with the odometry
/// between their ends; its misclosure, seen from the first node of the run of `from`, is
/// W_a * W_b^-1 (Mangelsdorf et al. 2018, eq. 5, conjugated: so it costs one product a pair).
template <class Group>
struct LoopOnChain {
  int edge;      ///< position in PackedGraph::edges
  int from, to;  ///< nodes, the earlier one first
  Group W;
  /// Covariance of the measurement as a left perturbation of W.
  typename Group::Jacobian covariance;
  typename Group::Jacobian adjoint;  ///< of W
};

/// The edges that are not odometry, in an order that depends on their ends and measurements alone.
template <class Group>
std::vector<LoopOnChain<Group>> loops_on_chain(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain);

/// Misclosure of the ring of two loops against the noise that the information claims.
struct RingMisclosure {
  double chi2 = 0;
  double log_determinant = 0;  ///< of its covariance
};

/// Both loops must join the same runs.
template <class Group>
RingMisclosure ring_misclosure(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                               const OdometryChain<Group>& chain);

/// The same of the ring that one loop closes with the odometry between its ends, which must lie in
/// one run: what drift would have to explain.
template <class Group>
RingMisclosure drift_misclosure(const LoopOnChain<Group>& loop, const OdometryChain<Group>& chain);

struct LoopPair {
  int a, b;  ///< positions in the vector of loops, a < b
  RingMisclosure ring;
};

/// For every loop its rings with the `neighbours` nearest other ones, at most `reach` poses away at
/// each end. Sorted, without repetition.
template <class Group>
std::vector<LoopPair> neighbouring_pairs(const std::vector<LoopOnChain<Group>>& loops,
                                         const OdometryChain<Group>& chain, int reach,
                                         int neighbours);

}  // namespace placegraph
