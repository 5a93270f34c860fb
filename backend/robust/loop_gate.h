#pragma once
#include <placegraph/backend/solver/packed_graph.h>

#include <vector>

namespace placegraph {

/// Factors by which the gate of a loop is wider than for Gaussian noise.
struct LoopGateWidth {
  double margin;        ///< factor of the gate over the chi-squared quantile
  double tail;          ///< multiple of the largest accepted error that another true loop may have
  double nearly_right;  ///< share of the map's extent, and of 180 deg
};

/// Threshold of the squared error, weighted by the information, up to which a loop is accepted.
/// It is calibrated to the noise of the graph: initially to that of the rings of neighbouring
/// loops, later to that of the accepted loops.
template <class Group>
class LoopGate {
 public:
  /// `probability`: share of true loops within the gate for Gaussian noise with the variance
  /// `noise_scale` and a margin of one.
  LoopGate(const PackedGraph<Group>& graph, double probability, double noise_scale,
           const LoopGateWidth& width);

  /// Variance of the noise relative to the information.
  double noise_scale() const { return scale_; }
  /// Largest squared error that is attributed to noise.
  double of_noise() const { return width_.margin * quantile_ * scale_; }
  /// Squared error up to which loop `edge` of `graph` is accepted at the current poses. The gate is
  /// wider for a loop that is nearly right, whose error is a small share of the extent of the graph
  /// of the constructor.
  double of_loop(const PackedGraph<Group>& graph, int edge) const;
  /// Squared error above which no loop is accepted.
  double widest() const;

  /// Calibrates the gate with the loops that have weight; `chi2`: squared error of every edge.
  /// Odometry is not used, because it may be wrong or deformed by a false loop.
  void learn(const PackedGraph<Group>& graph, const std::vector<double>& chi2);
  /// Widens the gate for a newly accepted loop with the squared error `chi2`, unless it was
  /// accepted only because it is nearly right.
  void widen(double chi2);

 private:
  bool nearly_right(const PackedGraph<Group>& graph, int edge) const;

  LoopGateWidth width_;
  double quantile_, scale_;
  double extent_;  ///< extent of the map [m]
  double limit_;
};

}  // namespace placegraph
