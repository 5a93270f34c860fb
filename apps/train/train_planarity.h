#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

struct TrainPlanarityArguments {
  std::string out;  ///< the model to write
  /// Rendered worlds to learn from.
  std::vector<std::string> worlds = {"corridor-loop", "warehouse", "town-loop"};
  int frames = 12;         ///< of each world
  int clouds = 300;        ///< generated ones; every fourth is left out and judged
  int rounds = 60;         ///< stumps
  std::uint64_t seed = 1;  ///< of clouds and worlds
  bool force = false;      ///< overwrite `out`
};

/// How a model judges the segments of some clouds.
struct PlanarityScore {
  int clouds = 0, segments = 0;
  int right = 0;                    ///< segments told rightly
  int planes = 0, planes_kept = 0;  ///< segments that are planes, and those taken for one
  int others = 0, others_kept = 0;  ///< the same of those that are none
};

struct TrainPlanarityResult {
  std::string out;
  PlanarityScore trained, left_out;
};

/// `placegraph train planarity`: learns which segments of a point cloud are planes and writes the
/// model. Progress goes to stderr. Throws ArgumentError, FileError.
TrainPlanarityResult train_planarity(const TrainPlanarityArguments& arguments);

/// Two lines.
std::string to_text(const TrainPlanarityResult& result);
std::string to_json(const TrainPlanarityResult& result);

}  // namespace placegraph::apps
