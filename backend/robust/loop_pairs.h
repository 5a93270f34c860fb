#pragma once
#include <placegraph/backend/solver/odometry_chain.h>

namespace placegraph {

/// A loop relative to the odometry.
/// W = T_first_from * T_from_to (measured) * T_first_to^-1 would be the identity without drift. Two
/// loops a, b between the same runs close a ring with the odometry between their ends; its
/// misclosure in the frame of the first node of the run of `from` is W_a * W_b^-1 (Mangelsdorf et
/// al. 2018, eq. 5, conjugated, so that it costs one product per pair).
template <class Group>
struct LoopOnChain {
  int edge;      ///< position in PackedGraph::edges
  int from, to;  ///< nodes, the earlier one first
  Group W;
  /// Covariance of the measurement as a left perturbation of W.
  typename Group::Jacobian covariance;
  typename Group::Jacobian adjoint;  ///< adjoint of W
};

/// The edges that are not odometry, in the order of their ends on the chain and their measurements.
template <class Group>
std::vector<LoopOnChain<Group>> loops_on_chain(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain);

/// Misclosure of the ring of two loops, weighted by the stated information.
struct RingMisclosure {
  double chi2 = 0;
  double log_determinant = 0;  ///< log determinant of the misclosure's covariance
};

/// The misclosure of the ring of two loops, which must connect the same runs.
template <class Group>
RingMisclosure ring_misclosure(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                               const OdometryChain<Group>& chain);

/// Whether the squared misclosure of the ring of two loops is at most `gate`.
///
/// It is that of ring_misclosure, without its determinant: for many pairs.
template <class Group>
bool ring_closes(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                 const OdometryChain<Group>& chain, double gate);

/// The misclosure of one loop with the odometry between its ends, which must be in one run.
/// For a true loop it is caused by drift.
template <class Group>
RingMisclosure drift_misclosure(const LoopOnChain<Group>& loop, const OdometryChain<Group>& chain);

struct LoopPair {
  int a, b;  ///< positions in the vector of loops, a < b
  RingMisclosure ring;
};

/// The rings of every loop with its `neighbours` nearest other loops, at most `reach` poses away at
/// each end. Sorted, without repetition.
template <class Group>
std::vector<LoopPair> neighbouring_pairs(const std::vector<LoopOnChain<Group>>& loops,
                                         const OdometryChain<Group>& chain, int reach,
                                         int neighbours);

}  // namespace placegraph
