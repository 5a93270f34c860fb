#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/landmark.h>

#include <vector>

namespace placegraph {

struct DetectorOptions {
  int max_features = 1000;
  int octaves = 4;
  double scale_factor = 1.3;
  int fast_threshold = 12;  ///< grey levels
  void check() const;
};
void visit(OptionVisitor& field, DetectorOptions& options);

/// ORB features (Rublee et al. 2011, by OpenCV), spread over the image by a grid: at most
/// max_features, `point_cam` empty. `mask` 0 = not here (may be empty).
std::vector<Feature> detect_features(const Image& image, const DetectorOptions& options,
                                     const Image& mask = {});

}  // namespace placegraph
