#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

struct FloatFeatureOptions;

/// Descriptors as rows.
using FloatDescriptors = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kSiftNumbers = 128;  ///< length of a descriptor

/// Key-points of an image with the roots of their SIFT descriptors (Lowe 2004).
///
/// RootSIFT (Arandjelovic & Zisserman 2012): 128 numbers of unit length, whose distance is that of
/// Hellinger.
struct FloatFeatures {
  /// Positions as shares of the width, so that images of all sizes are comparable; x right, y down.
  std::vector<Eigen::Vector2f> position;
  float height = 0;  ///< height of the image, as a share of its width
  FloatDescriptors descriptors;
};

/// Detects and describes the key-points of a grey image, 8 bits (ArgumentError otherwise). The
/// result is empty for an image without texture.
FloatFeatures float_features(const Image& grey, const FloatFeatureOptions& options);

/// Describes patches on a regular grid, upright, at two sizes, so that bare walls are described as
/// well as corners.
FloatFeatures dense_float_features(const Image& grey);

}  // namespace placegraph
