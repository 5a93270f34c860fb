#pragma once
#include <placegraph/frontend/internal/places/classifiers/place_classifier.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/map/map_options.h>

#include <functional>
#include <optional>

namespace placegraph {

/// What a classifier says of a place.
struct PlaceLabel {
  PlaceId place;
  std::optional<int> label;  ///< nothing: none is probable enough
  double probability = 0;    ///< of the likeliest, mean over its views
  int views = 0;
};

/// Which of the learned places each place of a map is: its views vote, each with its probabilities.
/// `image_of` hands over a keyframe's image, grey or in colour as those the classifier was trained
/// with. By place, in the map's order.
std::vector<PlaceLabel> label_places(const Map& map, const PlaceClassifier& classifier,
                                     const std::function<Image(const Keyframe&)>& image_of,
                                     const PlaceLabelOptions& options = {});

}  // namespace placegraph
