#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph {

/// Ratio of the dispersion of a graph's relative poses to their stated covariances.
struct DispersionFactor {
  double factor = 1;  ///< factor of the standard deviation
  /// Effective number of components that other measurements check (redundancy number).
  double redundancy = 0;
  /// Deviation from the stated covariance in standard deviations, by Wilson & Hilferty's normal
  /// approximation of chi-squared; negative if the dispersion is smaller.
  double deviations = 0;
};
struct VarianceComponents {
  DispersionFactor translation, rotation;
};

/// Estimates the variance components of the odometry edges of an optimized graph.
/// The graph has measured positions and is at its minimum. For the translations and the rotations
/// of all odometry edges they are (Foerstner 1979; Koch 1999, "Parameter estimation and hypothesis
/// testing in linear models", 3.6)
///
///   sum e^T Sigma^-1 e / sum tr(I - Sigma^-1 C),
///
/// with the edge's error e, its stated covariance Sigma and its covariance C in the graph. The
/// estimate is unbiased if the stated covariances are correct; otherwise apply it by
/// scale_odometry(), solve and repeat. Factors are 1 if nothing is checked (redundancy below a
/// half) or the graph has undetermined directions. Without odometry edges all relative poses are
/// used.
VarianceComponents odometry_variance_components(const PoseGraph& solved);

/// Approximate drift of a map by the stated covariances of its odometry, in the map's scale.
/// It is the root of the summed variances of the translations, and that of the rotations times the
/// map's radius. Without odometry edges all relative poses are used.
struct ClaimedDrift {
  double by_translation = 0, by_rotation = 0;
};
ClaimedDrift claimed_drift(const PoseGraph& map);

/// Divides the information of all relative poses by the squares of the factors.
/// A log scale is scaled with the rotation. The proportions among the relative poses stay the same.
void scale_odometry(PoseGraph& graph, double translation_factor, double rotation_factor);

}  // namespace placegraph
