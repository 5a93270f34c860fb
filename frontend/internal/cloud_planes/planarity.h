#pragma once
#include <placegraph/frontend/internal/cloud_planes/planar_segments.h>

#include <array>
#include <string>
#include <vector>

namespace placegraph {

constexpr int kPlanarityFeatures = 15;
/// What a segment looks like, free of scale.
using PlanarityFeatures = std::array<double, kPlanarityFeatures>;

/// Their names, in order.
const std::array<const char*, kPlanarityFeatures>& planarity_feature_names();

/// Residuals against noise and flatness, their distribution and how much less a curved surface
/// leaves, the spread of points and normals, and the border: whether the surface goes on beyond it
/// at a small turn, as a slice of a curved one does. `contacts`: as of `contacts_of_cells`.
PlanarityFeatures planarity_features(const PlanarSegment& segment, const CloudPoints& points,
                                     const SuperPoints& cloud,
                                     const std::vector<std::vector<int>>& contacts);

/// Boosted stumps: P(plane) = 1 / (1 + exp(-2 F)), F the sum of their votes.
struct PlanarityModel {
  struct Stump {
    int feature = 0;
    double threshold = 0, below = 0, above = 0;  ///< the vote
  };
  std::vector<Stump> stumps;
  double probability(const PlanarityFeatures& features) const;
};

/// The model that comes with the library (docs/planes.md says what it was trained on).
PlanarityModel built_in_planarity();

/// Text: a line `planarity FEATURES`, then `name threshold below above` a stump. Reading throws
/// FileError "path:line: ..." for anything else.
std::string to_text(const PlanarityModel& model);
PlanarityModel parse_planarity(const std::string& text, const std::string& path);

struct PlanaritySample {
  PlanarityFeatures features{};
  bool planar = false;
};

/// GentleBoost (Friedman, Hastie & Tibshirani 2000) of stumps; the classes weigh the same in all.
/// Same samples, same bits. Throws ArgumentError unless there are samples of both.
PlanarityModel train_planarity(const std::vector<PlanaritySample>& samples, int rounds = 60);

}  // namespace placegraph
