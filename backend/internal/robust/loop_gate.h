#pragma once
#include <placegraph/backend/internal/solver/packed_graph.h>

#include <vector>

namespace placegraph {

/// How much wider than Gaussian noise the gate of a loop is.
struct LoopGateWidth {
  double margin;        ///< of the gate over the chi-squared quantile
  double tail;          ///< times the largest error of true loops that another one may have
  double nearly_right;  ///< share of the map's extent, and of half a turn
};

/// Up to which squared error, in units of what the information claims, a loop is taken for true.
/// It is calibrated to the noise of the graph: of the rings of neighbouring loops at first, of the
/// loops that are taken later.
template <class Group>
class LoopGate {
 public:
  /// `probability`: share of true loops within it, were noise Gaussian with a variance of
  /// `noise_scale` and the margin one.
  LoopGate(const PackedGraph<Group>& graph, double probability, double noise_scale,
           const LoopGateWidth& width);

  /// Variance of the noise in units of what the information claims.
  double noise_scale() const { return scale_; }
  /// Squared error that may be noise.
  double of_noise() const { return width_.margin * quantile_ * scale_; }
  /// Squared error up to which loop `edge` of `graph` is taken for true at its present poses: wider
  /// where it says nearly the right thing, off by a small share of the extent of the graph that the
  /// gate was made for.
  double of_loop(const PackedGraph<Group>& graph, int edge) const;
  /// Squared error beyond which no loop is taken.
  double widest() const;

  /// Learns from the loops that have weight; `chi2`: squared error of every edge. Odometry that a
  /// false loop bends, or that is wrong, says nothing of the noise.
  void learn(const PackedGraph<Group>& graph, const std::vector<double>& chi2);
  /// A loop more is taken that costs `chi2`: others may have as much and more, unless it was taken
  /// only for being nearly right.
  void widen(double chi2);

 private:
  bool nearly_right(const PackedGraph<Group>& graph, int edge) const;

  LoopGateWidth width_;
  double quantile_, scale_;
  double extent_;  ///< of the map [m]
  double limit_;
};

}  // namespace placegraph
