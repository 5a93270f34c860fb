#pragma once
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <functional>
#include <optional>

namespace placegraph {

struct PlaceLabelOptions {
  double min_probability = 0.5;  ///< mean over a place's views, below which it stays without label
  void check() const;
};
void visit(OptionVisitor& field, PlaceLabelOptions& options);

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
