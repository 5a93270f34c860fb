#pragma once
#include <placegraph/frontend/labels/box_sums.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Features of each pixel, as bytes, at half the size of the image.
///
/// Brightness, absolute and by its rank in the image; colour, absolute and relative to that of the
/// image (so that a change of light has little effect); strength and direction of edges at two
/// scales; blobs at three scales.
struct SceneChannels {
  static constexpr int kCount = 32;
  enum Channel {
    kBrightness,
    kRank,
    kRed,
    kBlue,
    kRedRelative,
    kBlueRelative,
    kSaturation,
    kContrast,
    kEdge,                    ///< strength, relative to the image's mean
    kDirection,               ///< 6 of them: strength along 0, 30, ... 150 degrees
    kShare = kDirection + 6,  ///< 6 of them: share of each direction in the surroundings
    kCoarseEdge = kShare + 6,
    kCoarseUpright,
    kCoarseLevel,
    kBlob,               ///< 3 scales
    kShade = kBlob + 3,  ///< brightness relative to a wide neighbourhood
    kBlueness,
    kGreenness,
    kEnd
  };
  int rows = 0, cols = 0;
  std::vector<std::uint8_t> pixels;  ///< rows x cols x kCount

  const std::uint8_t* at(int v, int u) const {
    return pixels.data() + (static_cast<std::size_t>(v) * static_cast<std::size_t>(cols) +
                            static_cast<std::size_t>(u)) *
                               kCount;
  }
};

/// Computes the channels of a CV_8UC3 BGR image with even sides; throws ArgumentError for another.
SceneChannels scene_channels(const Image& bgr);

}  // namespace placegraph
