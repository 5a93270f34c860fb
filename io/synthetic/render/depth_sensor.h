#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/io/synthetic/render/rasterizer.h>

#include <cstdint>

namespace placegraph::synthetic {

/// How a depth camera measures; with these defaults exactly.
struct DepthSensor {
  double step = 0;           ///< inverse depth is a multiple of this [1/m]; 0 = any
  double noise = 0;          ///< sigma of inverse depth, white [1/m]
  double holes = 0;          ///< share of the surfaces' pixels without a measurement
  double flying_pixels = 0;  ///< share of the pixels within 2 px of a depth edge that lie between
  double scale = 1;          ///< measured over true depth
};

/// The depth image [m] of a camera that sees `inverse_depth` (CV_32FC1 [1/m], 0 = nothing) in
/// `view`. Its holes are the least reliable pixels: on patches of the surfaces that stay in their
/// place, where a surface is seen at a grazing angle, and on the far side of depth edges.
/// `noise_seed` belongs to this image alone, `surface_seed` to the scene.
Image measure_depth(const Image& inverse_depth, const View& view, const DepthSensor& sensor,
                    std::uint32_t noise_seed, std::uint32_t surface_seed);

}  // namespace placegraph::synthetic
