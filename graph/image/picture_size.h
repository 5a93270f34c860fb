#pragma once
#include <cstdint>

namespace placegraph {

/// Whether a picture of this size is decoded: sides of 1 to 2^20 px and at most 2^30 pixels.
constexpr bool is_decodable_size(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t kMostSide = std::uint64_t{1} << 20, kMostPixels = std::uint64_t{1} << 30;
  return width > 0 && height > 0 && width <= kMostSide && height <= kMostSide &&
         width * height <= kMostPixels;
}

}  // namespace placegraph
