#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// A rectangle of pixels [u0, u1) x [v0, v1).
struct PixelBox {
  int u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};

/// Means of many byte channels over any rectangle, in a time that does not depend on its size.
///
/// Integral images with interleaved channels.
class BoxSums {
 public:
  /// Builds the integral images. `pixels`: rows x cols x channels bytes, with the channels of one
  /// pixel beside each other. Throws ArgumentError if the sizes do not agree or a sum could
  /// overflow (over 2^23 pixels).
  BoxSums(const std::vector<std::uint8_t>& pixels, int rows, int cols, int channels);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  int channels() const { return channels_; }

  /// Computes the rounded means over the part of the box within the image; a box outside is first
  /// moved to the nearest pixels, so that every box has a result. `means`: one per channel.
  void means(PixelBox box, std::uint8_t* means) const;

 private:
  int rows_, cols_, channels_;
  std::vector<std::int32_t> sums_;
};

}  // namespace placegraph
