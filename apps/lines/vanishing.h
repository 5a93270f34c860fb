#pragma once
#include <placegraph/frontend/internal/vanishing/scene_directions.h>

#include <cstdint>
#include <string>

namespace placegraph::apps {

struct VanishingArguments {
  std::string in;     ///< file of segments, `u1 v1 u2 v2` a line [px]
  std::string calib;  ///< of their camera
  SceneDirectionOptions options;
  std::uint64_t seed = 1;  ///< of the random samples
};

struct VanishingResult {
  std::string in;
  std::size_t segments = 0;
  SceneDirections scene;
  double cpu_ms = 0;
};

/// `placegraph vanishing`: in which directions the edges of a scene point. Throws ArgumentError,
/// FileError, and NoAnswer where there are too few segments; no common direction is an answer.
VanishingResult vanishing(const VanishingArguments& arguments);

/// Some lines.
std::string to_text(const VanishingResult& result);
std::string to_json(const VanishingResult& result);

}  // namespace placegraph::apps
