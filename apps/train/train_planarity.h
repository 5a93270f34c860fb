#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

struct TrainPlanarityArguments {
  std::string out;  ///< file for the model
  /// Rendered worlds of the training set.
  std::vector<std::string> worlds = {"corridor-loop", "warehouse", "town-loop"};
  int frames = 12;         ///< number of frames of each world
  int clouds = 300;        ///< number of generated clouds; every fourth is in the test set
  int rounds = 60;         ///< number of decision stumps
  std::uint64_t seed = 1;  ///< seed of clouds and worlds
  bool force = false;      ///< overwrite `out`
};

/// Evaluation of a model on the segments of some clouds.
struct PlanarityScore {
  int clouds = 0, segments = 0;
  int right = 0;                    ///< correctly classified segments
  int planes = 0, planes_kept = 0;  ///< planar segments, and those of them classified as planar
  int others = 0, others_kept = 0;  ///< other segments, and those of them classified as planar
};

struct TrainPlanarityResult {
  std::string out;
  PlanarityScore trained, left_out;
};

/// Trains the classifier of planar segments of point clouds: `placegraph train planarity`.
/// It writes the model; progress goes to stderr. Throws ArgumentError, FileError.
TrainPlanarityResult train_planarity(const TrainPlanarityArguments& arguments);

/// Two lines.
std::string to_text(const TrainPlanarityResult& result);
std::string to_json(const TrainPlanarityResult& result);

}  // namespace placegraph::apps
