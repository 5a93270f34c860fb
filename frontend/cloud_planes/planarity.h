#pragma once
#include <placegraph/frontend/cloud_planes/planar_segments.h>

#include <array>
#include <string>
#include <vector>

namespace placegraph {

constexpr int kPlanarityFeatures = 15;
/// Features of a segment, invariant to scale.
using PlanarityFeatures = std::array<double, kPlanarityFeatures>;

/// Names of the features, in order.
const std::array<const char*, kPlanarityFeatures>& planarity_feature_names();

/// Computes the features of a segment.
///
/// Residuals relative to noise and flatness, their distribution and their decrease with a curved
/// surface, the spread of points and normals, and the border: whether the surface continues beyond
/// it at a small angle, as that of a slice of a curved surface. `contacts`: the result of
/// `contacts_of_cells`.
PlanarityFeatures planarity_features(const PlanarSegment& segment, const CloudPoints& points,
                                     const SuperPoints& cloud,
                                     const std::vector<std::vector<int>>& contacts);

/// Boosted stumps: P(plane) = 1 / (1 + exp(-2 F)), F the sum of their votes.
struct PlanarityModel {
  struct Stump {
    int feature = 0;
    double threshold = 0, below = 0, above = 0;  ///< vote on either side of the threshold
  };
  std::vector<Stump> stumps;
  double probability(const PlanarityFeatures& features) const;
};

/// Model that is built into the library (docs/planes.md documents its training).
PlanarityModel built_in_planarity();

/// Text of a model: a line `planarity FEATURES`, then `name threshold below above` for each stump.
/// Reading throws FileError "path:line: ..." for anything else.
std::string to_text(const PlanarityModel& model);
PlanarityModel parse_planarity(const std::string& text, const std::string& path);

struct PlanaritySample {
  PlanarityFeatures features{};
  bool planar = false;
};

/// Trains stumps by GentleBoost (Friedman, Hastie & Tibshirani 2000); both classes have equal
/// weight.
///
/// The same samples give the same bits. Throws ArgumentError unless there are samples of both
/// classes.
PlanarityModel train_planarity(const std::vector<PlanaritySample>& samples, int rounds = 60);

}  // namespace placegraph
