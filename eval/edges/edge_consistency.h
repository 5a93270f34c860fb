#pragma once
#include <placegraph/eval/edges/edge_error.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Errors relative to a covariance.
struct Nees {
  /// Normalized estimation error squared of an edge per degree of freedom, e^T covariance^-1 e /
  /// dof with the error e against the truth: mean and median. The mean is 1 if the covariances are
  /// right (Bar-Shalom, Li and Kirubarajan 2001, 5.4.2), and larger if they are too small.
  double mean = 0, median = 0;
  /// Share of edges with an error beyond 99 % of the distribution.
  double share_beyond_99 = 0;
};

/// Errors of one quantity of the edges, as root mean squares.
struct AxisConsistency {
  std::string name;     ///< one of edge_axes()
  double error = 0;     ///< [m], [rad]; of similarities relative to the length, or of the log scale
  double stated = 0;    ///< standard deviation that the edges state
  double of_truth = 0;  ///< standard deviation of the truth
  double normalized = 0;  ///< error over the standard deviation by edge and truth
};

/// Errors of measured relative poses relative to their stated covariances.
struct EdgeConsistency {
  int edges = 0;         ///< judged edges
  int unknown = 0;       ///< edges without the true pose of an end or, in a graph over Sim(3),
                         ///< without a true scale, not judged
  int interpolated = 0;  ///< edges with an end whose true pose was interpolated, not judged
  int degrees_of_freedom = 0;  ///< sum over all judged edges
  Nees by_stated;              ///< by the stated covariances
  Nees with_truth;             ///< by the sums of the stated covariances and those of the truth
  /// Share of the squares of the errors, weighted by the stated informations, that the noise of
  /// the truth makes; at most 1.
  double truth_share = 0;
  std::vector<AxisConsistency> axes;  ///< those that were tested
};

/// Compares the edges of a graph with the truth, by their source.
/// Nothing is fitted: only relative poses are compared. Throws ArgumentError for edges in the
/// plane.
std::map<ConstraintSource, EdgeConsistency> edge_consistency(
    const std::vector<RelativePoseConstraint>& edges, const TrueNodes& truth);

/// What the errors of edges say about their covariances.
enum class EdgeVerdict {
  kNoEdges,      ///< no edge was judged
  kTooFewEdges,  ///< the edges allow several of the answers below
  kNotTestable,  ///< the noise of the truth makes more than half of the errors
  kTooLarge,     ///< NEES below 0.5
  kHold,         ///< NEES from 0.5 to 2
  kTooSmall,     ///< NEES above 2
};

/// The name of a verdict as in JSON: "hold", "too small" and so on.
const char* to_string(EdgeVerdict verdict);

/// The ends of the interval of 95 % of the mean NEES of more edges of the same kind.
/// They follow from the chi-squared distribution of the degrees of freedom of all edges.
std::pair<double, double> nees_interval(const Nees& nees, int degrees_of_freedom);

/// The verdict on edges by the intervals of their mean NEES.
/// Noise of the truth makes errors larger: covariances are too large if they are by the stated
/// covariances alone, and too small if they are with the truth's. An interval that spans a bound
/// allows no answer.
EdgeVerdict verdict_on(const EdgeConsistency& consistency);

/// The verdict as a sentence, "The covariances of the odometry hold: NEES 1.10 (0.5 to 2).".
std::string sentence_of(ConstraintSource source, const EdgeConsistency& consistency);

}  // namespace placegraph
