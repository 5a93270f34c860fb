#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph {

/// How much more (or less) the relative poses of a graph scatter than they claim.
struct DispersionFactor {
  double factor = 1;  ///< on the standard deviation
  /// How many components other measurements check, as if each were checked in full or not at all.
  double redundancy = 0;
  /// By how many standard deviations the claim is missed, by Wilson & Hilferty's normal
  /// approximation of chi-squared; negative if they scatter less.
  double deviations = 0;
};
struct VarianceComponents {
  DispersionFactor translation, rotation;
};

/// Estimates variance components (Foerstner 1979; Koch 1999, "Parameter estimation and hypothesis
/// testing in linear models", 3.6) at the minimum of a graph that has measured positions: for the
/// translations and the rotations of all odometry edges
///
///   sum e^T Sigma^-1 e / sum tr(I - Sigma^-1 C),
///
/// with the edge's error e, the covariance Sigma that it claims and the covariance C that the graph
/// leaves to it. Unbiased where the claims hold; where they do not, scale_odometry() with it, solve
/// and repeat. Factors are 1 where nothing is checked (redundancy below a half) or the graph has
/// open directions. Without odometry edges all relative poses count.
VarianceComponents odometry_variance_components(const PoseGraph& solved);

/// How far the odometry of a map would carry it by what it claims, roughly [map's unit]: the root
/// of the summed variances of its translations, and of its rotations times the map's radius.
/// Without odometry edges all relative poses count.
struct ClaimedDrift {
  double by_translation = 0, by_rotation = 0;
};
ClaimedDrift claimed_drift(const PoseGraph& map);

/// Divides the information of all relative poses by the squares of the factors (a log scale goes
/// with the rotation). So what the poses say of each other keeps its proportions.
void scale_odometry(PoseGraph& graph, double translation_factor, double rotation_factor);

}  // namespace placegraph
