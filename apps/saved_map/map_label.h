#pragma once
#include <placegraph/pipeline/internal/map/place_labeller.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MapLabelArguments {
  std::string map;         ///< map.db, or the folder of placegraph run with it; written anew
  std::string house;       ///< a folder with images and labels.txt to learn from
  std::string names;       ///< file with a name a line, the first of label 0; empty: numbers
  std::vector<int> range;  ///< first and last image to learn from; empty: all
  PlaceLabelOptions options;
};

struct MapLabelResult {
  std::string map;
  std::size_t labelled = 0, places = 0;  ///< places that got a label, and all
  std::size_t views = 0;                 ///< of the map
  double accuracy = 0;                   ///< of the classifier on left out parts of what it learned
  nlohmann::json list = nlohmann::json::array();  ///< every place with its label
};

/// `placegraph map label`: labels the places of a saved map by a classifier learned from labelled
/// images. Throws ArgumentError, FileError, and NoAnswer where the map is not finished or empty.
MapLabelResult map_label(const MapLabelArguments& arguments);

/// One line.
std::string to_text(const MapLabelResult& result);
std::string to_json(const MapLabelResult& result);

}  // namespace placegraph::apps
