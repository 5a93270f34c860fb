#pragma once
#include <placegraph/frontend/cloud_planes/cloud_planes_options.h>
#include <placegraph/graph/measurements/point_cloud.h>

#include <array>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Number of features of a segment.
constexpr int kPlanarityFeatures = 15;
/// Features of a segment, invariant to scale.
using PlanarityFeatures = std::array<double, kPlanarityFeatures>;

/// Names of the features, in order.
const std::array<const char*, kPlanarityFeatures>& planarity_feature_names();

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

/// Text of a model.
///
/// A line `planarity FEATURES`, then `name threshold below above` for each stump.
std::string to_text(const PlanarityModel& model);
/// Reads the text of a model; throws FileError "path:line: ..." for anything else.
PlanarityModel parse_planarity(const std::string& text, const std::string& path);

/// A segment of a training set.
struct PlanaritySample {
  PlanarityFeatures features{};
  bool planar = false;
};

/// Segments of a cloud with their features, for the training of a model.
///
/// Those whose points are nearly all of one plane, and those that are mostly something else.
///
/// `labels` are those of the points: 0 none, else the number of the plane. Mixed segments are left
/// out. Throws ArgumentError for invalid options or sizes.
std::vector<PlanaritySample> planarity_samples(const PointCloud& cloud,
                                               const std::vector<int>& labels,
                                               const CloudPlanesOptions& options);

/// Trains stumps by GentleBoost (Friedman, Hastie & Tibshirani 2000).
///
/// Both classes have equal weight.
///
/// The same samples give the same bits. Throws ArgumentError unless there are samples of both
/// classes.
PlanarityModel train_planarity(const std::vector<PlanaritySample>& samples, int rounds = 60);

}  // namespace placegraph
