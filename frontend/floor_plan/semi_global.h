#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace placegraph {

/// Costs of `levels` hypotheses for each pixel of an image.
struct CostVolume {
  CostVolume(int width_px, int height_px, int level_count)
      : width(width_px),
        height(height_px),
        levels(level_count),
        costs(static_cast<std::size_t>(width_px) * height_px * level_count) {}
  std::size_t at(int u, int v) const {
    return (static_cast<std::size_t>(v) * width + u) * static_cast<std::size_t>(levels);
  }
  int width, height, levels;
  /// Costs of the levels of a pixel beside each other, pixels by rows.
  std::vector<std::uint8_t> costs;
};

/// Sums the least costs of paths that end in each pixel at each level, over eight directions.
///
/// Hirschmueller 2008, "Stereo processing by semi-global matching and mutual information". The
/// result has the layout of the costs. Throws ArgumentError for penalties below 0 or above 4000.
std::vector<std::uint16_t> sum_over_paths(const CostVolume& volume, const PathCosts& penalty);

}  // namespace placegraph
