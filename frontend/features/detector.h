#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/landmark.h>

#include <vector>

namespace placegraph {

/// Detects ORB features (Rublee et al. 2011, by OpenCV), spread over the image by a grid.
///
/// At most max_features, `point_cam` empty. `mask`: no features where it is 0 (may be empty).
std::vector<Feature> detect_features(const Image& image, const DetectorOptions& options,
                                     const Image& mask = {});

}  // namespace placegraph
