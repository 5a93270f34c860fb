#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/map/map_options.h>

#include <functional>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

class PlaceClassifier;

/// Classification of a place.
struct PlaceLabel {
  PlaceId place;             ///< the place
  std::optional<int> label;  ///< nothing: no label is probable enough
  double probability = 0;    ///< mean probability of the most probable label over the views
  int views = 0;             ///< number of its views
};

/// Classifies each place of a map as one of the learned places.
///
/// Its views vote, each with its probabilities. `image_of` returns a keyframe's image, grey or in
/// colour as in the training of the classifier. Results are in the map's order of places.
std::vector<PlaceLabel> label_places(const Map& map, const PlaceClassifier& classifier,
                                     const std::function<Image(const Keyframe&)>& image_of,
                                     const PlaceLabelOptions& options = {});

}  // namespace placegraph
