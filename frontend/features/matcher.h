#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/landmark.h>

#include <vector>

namespace placegraph {

/// A match of two features.
struct FeatureMatch {
  int a = 0, b = 0;  ///< indices into the two feature lists
  int distance = 0;  ///< Hamming distance [bits]
};

/// Mutually best matches that pass the ratio test, ascending in a.
///
/// Only features of b whose flag in `use_b` is set are compared (empty: all).
std::vector<FeatureMatch> match_features(const std::vector<Feature>& a,
                                         const std::vector<Feature>& b,
                                         const MatcherOptions& options,
                                         const std::vector<bool>& use_b = {});

/// Matches features along the epipolar lines of a known motion.
///
/// A candidate is within `band_px` of the line of the feature in a, and its ray does not meet a's
/// behind either camera.
std::vector<FeatureMatch> match_epipolar(const Camera& camera, const std::vector<Feature>& a,
                                         const std::vector<Feature>& b, const SE3& T_a_b,
                                         double band_px, const MatcherOptions& options);

}  // namespace placegraph
