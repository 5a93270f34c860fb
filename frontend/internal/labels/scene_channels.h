#pragma once
#include <placegraph/frontend/internal/labels/box_sums.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// What one pixel shows, as bytes: brightness as it is and by its rank in the picture, colour as it
/// is and relative to the picture's (so that another light changes it little), strength and
/// direction of edges at two scales, blobs at three. At half the size of the picture.
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
    kEdge,                    ///< strength, relative to the picture's mean
    kDirection,               ///< 6 of them: strength along 0, 30, ... 150 degrees
    kShare = kDirection + 6,  ///< 6 of them: share of each direction in the surroundings
    kCoarseEdge = kShare + 6,
    kCoarseUpright,
    kCoarseLevel,
    kBlob,               ///< 3 scales
    kShade = kBlob + 3,  ///< darker or brighter than wide surroundings
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

/// Of a CV_8UC3 BGR picture with even sides; throws ArgumentError for another.
SceneChannels scene_channels(const Image& bgr);

}  // namespace placegraph
