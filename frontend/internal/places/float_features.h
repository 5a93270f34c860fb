#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

struct FloatFeatureOptions {
  int width_px = 320;      ///< images are brought to it, smaller ones too
  int max_features = 400;  ///< the strongest of an image
  /// Of the scale-space extrema that count, for grey levels of [0, 1]: a quarter of the usual,
  /// as walls and lawns have weak ones only.
  double contrast = 0.01;
  void check() const;
};
void visit(OptionVisitor& field, FloatFeatureOptions& options);

/// Descriptors by rows.
using FloatDescriptors = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kSiftNumbers = 128;  ///< of a descriptor

/// Key-points of an image with the roots of their SIFT descriptors (Lowe 2004; RootSIFT,
/// Arandjelovic & Zisserman 2012): 128 numbers of unit length, whose distance is that of Hellinger.
struct FloatFeatures {
  /// Positions as shares of the width, so that images of all sizes compare; x right, y down.
  std::vector<Eigen::Vector2f> position;
  float height = 0;  ///< of the image, as a share of its width
  FloatDescriptors descriptors;
};

/// `grey`: 8 bits (ArgumentError otherwise). Images without texture have none.
FloatFeatures float_features(const Image& grey, const FloatFeatureOptions& options);

/// The same on a regular grid, upright, at two sizes: bare walls are described as well as corners.
FloatFeatures dense_float_features(const Image& grey);

}  // namespace placegraph
