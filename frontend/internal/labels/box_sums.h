#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// A rectangle of pixels [u0, u1) x [v0, v1).
struct PixelBox {
  int u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};

/// Means of many channels of bytes over any rectangle, in a time that does not depend on its size:
/// integral images whose channels lie beside each other.
class BoxSums {
 public:
  /// `pixels`: rows x cols x channels bytes, the channels of one pixel beside each other. Throws
  /// ArgumentError if the sizes do not agree or a sum could overflow (over 2^23 pixels).
  BoxSums(const std::vector<std::uint8_t>& pixels, int rows, int cols, int channels);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  int channels() const { return channels_; }

  /// The rounded means over the part of the box within the image; a box that lies outside is moved
  /// to the nearest pixels first, so every box has an answer. `means`: one a channel.
  void means(PixelBox box, std::uint8_t* means) const;

 private:
  int rows_, cols_, channels_;
  std::vector<std::int32_t> sums_;
};

}  // namespace placegraph
