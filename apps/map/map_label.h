#pragma once
#include <placegraph/pipeline/map/place_labeller.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MapLabelArguments {
  std::string map;    ///< map.db, or a folder written by `placegraph run`; the map is rewritten
  std::string house;  ///< folder with the training set: images and labels.txt
  std::string names;  ///< file of names, one per line, the first of label 0; empty: numbers
  std::vector<int> range;  ///< first and last image of the training set; empty: all
  PlaceLabelOptions options;
};

struct MapLabelResult {
  std::string map;
  std::size_t labelled = 0, places = 0;  ///< number of places with a label, and of all places
  std::size_t views = 0;                 ///< number of views of the map
  double accuracy = 0;  ///< cross-validated accuracy of the classifier on the training set
  nlohmann::json list = nlohmann::json::array();  ///< every place with its label
};

/// Labels the places of a saved map by a trained classifier: `placegraph map label`.
/// It is trained on labelled images. Throws ArgumentError, FileError, and NoResult if the map is
/// not finished or empty.
MapLabelResult map_label(const MapLabelArguments& arguments);

/// One line.
std::string to_text(const MapLabelResult& result);
std::string to_json(const MapLabelResult& result);

}  // namespace placegraph::apps
