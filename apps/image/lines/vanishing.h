#pragma once
#include <placegraph/frontend/vanishing/scene_directions.h>

#include <cstdint>
#include <string>

namespace placegraph::apps {

struct VanishingArguments {
  std::string in;     ///< file of segments, `u1 v1 u2 v2` per line [px]
  std::string calib;  ///< calibration file of their camera
  SceneDirectionOptions options;
  std::uint64_t seed = 1;  ///< seed of the random samples
};

struct VanishingResult {
  std::string in;
  std::size_t segments = 0;
  SceneDirections scene;
  double cpu_ms = 0;
};

/// Finds the vanishing points of an image's edges: `placegraph image vanishing`.
/// Throws ArgumentError, FileError, and NoResult if there are too few segments. A result without a
/// common direction is a result.
VanishingResult vanishing(const VanishingArguments& arguments);

/// Some lines.
std::string to_text(const VanishingResult& result);
std::string to_json(const VanishingResult& result);

}  // namespace placegraph::apps
