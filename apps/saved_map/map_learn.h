#pragma once
#include <placegraph/pipeline/internal/map/map_learner.h>

#include <cstddef>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MapLearnArguments {
  std::string images, out;  ///< a folder of images in the order they were taken; the map to write
  std::vector<int> range;   ///< first and last image; empty: all
  std::vector<std::string> settings;  ///< "key=value", above `options`
  MapLearnerOptions options;
  bool force = false;  ///< overwrite `out`
};

struct MapLearnResult {
  std::string out;
  std::size_t images = 0, places = 0;
};

/// `placegraph map learn`: a map of how places look, from images without a camera. Throws
/// ArgumentError, FileError.
MapLearnResult map_learn(const MapLearnArguments& arguments);

/// One line.
std::string to_text(const MapLearnResult& result);

}  // namespace placegraph::apps
