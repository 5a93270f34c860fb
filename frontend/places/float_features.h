#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

struct FloatFeatureOptions {
  int width_px = 320;      ///< width to which images are resized, smaller ones too
  int max_features = 400;  ///< number of the strongest key-points kept in an image
  /// Minimum contrast of scale-space extrema, for grey levels in [0, 1]: a quarter of the usual
  /// value, as walls and lawns have only weak extrema.
  double contrast = 0.01;
  void check() const;
};
void visit(OptionVisitor& field, FloatFeatureOptions& options);

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
