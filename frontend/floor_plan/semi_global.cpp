#include <placegraph/frontend/floor_plan/semi_global.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>

namespace placegraph {
namespace {

// Paths of each of two passes: from beside, and from three pixels of a row.
constexpr int kPaths = 4;
constexpr std::uint16_t kWall = 60000;

/// Costs of the paths through one pixel, with a wall on both sides of the levels.
struct PathRow {
  PathRow(std::size_t width, std::size_t levels)
      : stride(levels + 2), costs((width + 2) * stride, 0), least(width + 2, 0) {
    for (std::size_t i = 0; i < least.size(); ++i)
      costs[i * stride] = costs[(i + 1) * stride - 1] = kWall;
  }
  /// Costs for the pixel in column u; -1 and the width are outside the image, where paths begin.
  std::uint16_t* at(int u) { return costs.data() + static_cast<std::size_t>(u + 1) * stride + 1; }
  std::uint16_t& least_at(int u) { return least[static_cast<std::size_t>(u + 1)]; }

  std::size_t stride;
  std::vector<std::uint16_t> costs, least;
};

/// Extends a path to a pixel; returns its least cost there.
std::uint16_t extend(const std::uint8_t* cost, const std::uint16_t* before, std::uint16_t least,
                     int levels, const PathCosts& penalty, std::uint16_t* after,
                     std::uint16_t* sum) {
  const auto step = static_cast<std::uint16_t>(penalty.step);
  const auto jump = static_cast<std::uint16_t>(least + penalty.jump);
  std::uint16_t lowest = kWall;
  for (int d = 0; d < levels; ++d) {
    const std::uint16_t beside = std::min(before[d - 1], before[d + 1]);
    const std::uint16_t stay = std::min(before[d], static_cast<std::uint16_t>(beside + step));
    const auto value = static_cast<std::uint16_t>(cost[d] + std::min(stay, jump) - least);
    after[d] = value;
    sum[d] = static_cast<std::uint16_t>(sum[d] + value);
    lowest = std::min(lowest, value);
  }
  return lowest;
}

}  // namespace

std::vector<std::uint16_t> sum_over_paths(const CostVolume& volume, const PathCosts& penalty) {
  constexpr int kMostPenalty = 4000;  // so that sums of eight paths do not overflow
  require(penalty.step >= 0 && penalty.jump >= 0 && penalty.step <= kMostPenalty &&
              penalty.jump <= kMostPenalty,
          "semi-global matching: penalties must be from 0 to 4000");
  std::vector<std::uint16_t> sums(volume.costs.size(), 0);
  const int width = volume.width, height = volume.height, levels = volume.levels;
  for (const int direction : {1, -1}) {
    std::vector<PathRow> last, now;
    for (int path = 0; path < kPaths; ++path)
      for (std::vector<PathRow>* rows : {&last, &now})
        rows->emplace_back(static_cast<std::size_t>(width), static_cast<std::size_t>(levels));
    for (int row = 0; row < height; ++row) {
      const int v = direction > 0 ? row : height - 1 - row;
      for (int column = 0; column < width; ++column) {
        const int u = direction > 0 ? column : width - 1 - column;
        const std::size_t at = volume.at(u, v);
        const std::array<int, kPaths> from{u - direction, u - 1, u, u + 1};
        for (std::size_t path = 0; path < kPaths; ++path) {
          PathRow& before = path == 0 ? now[path] : last[path];
          now[path].least_at(u) =
              extend(volume.costs.data() + at, before.at(from[path]), before.least_at(from[path]),
                     levels, penalty, now[path].at(u), sums.data() + at);
        }
      }
      std::swap(now, last);
    }
  }
  return sums;
}

}  // namespace placegraph
