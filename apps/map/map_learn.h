#pragma once
#include <placegraph/pipeline/map/map_learner.h>

#include <cstddef>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MapLearnArguments {
  std::string images, out;  ///< folder of images in the order of their capture; file for the map
  std::vector<int> range;   ///< first and last image; empty: all
  std::vector<std::string> settings;  ///< "key=value"; they override `options`
  MapLearnerOptions options;
  bool force = false;  ///< overwrite `out`
};

struct MapLearnResult {
  std::string out;
  std::size_t images = 0, places = 0;
};

/// Makes a map for recognition from images without a calibration: `placegraph map learn`.
/// Throws ArgumentError, FileError.
MapLearnResult map_learn(const MapLearnArguments& arguments);

/// One line.
std::string to_text(const MapLearnResult& result);

}  // namespace placegraph::apps
