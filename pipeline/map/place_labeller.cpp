#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/pipeline/map/place_labeller.h>

#include <unordered_map>

namespace placegraph {

std::vector<PlaceLabel> label_places(const Map& map, const PlaceClassifier& classifier,
                                     const std::function<Image(const Keyframe&)>& image_of,
                                     const PlaceLabelOptions& options) {
  options.check();
  struct Votes {
    Eigen::VectorXd probabilities;
    int views = 0;
  };
  std::unordered_map<PlaceId, Votes> votes;
  for (const Keyframe& keyframe : map.keyframes) {
    const Eigen::VectorXd predicted = classifier.classify(describe_for_classes(image_of(keyframe)));
    Votes& of_place = votes[keyframe.place];
    if (of_place.views++ == 0)
      of_place.probabilities = predicted;
    else
      of_place.probabilities += predicted;
  }
  std::vector<PlaceLabel> labels;
  for (const Place& place : map.place_graph.places) {
    PlaceLabel& label = labels.emplace_back();
    label.place = place.id;
    const auto of_place = votes.find(place.id);
    if (of_place == votes.end()) continue;
    label.views = of_place->second.views;
    Eigen::Index best = 0;
    label.probability = of_place->second.probabilities.maxCoeff(&best) / label.views;
    if (label.probability >= options.min_probability) label.label = static_cast<int>(best);
  }
  return labels;
}

}  // namespace placegraph
