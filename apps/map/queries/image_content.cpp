#include "apps/map/queries/image_content.h"

#include <placegraph/frontend/labels/street_labels.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/environment.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/environment.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/shipped/scene_models.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// Shares of the image by class; "none" for pixels without a class.
json shares_of(const SceneLabels& labels, const std::vector<std::string>& classes) {
  std::vector<std::int64_t> counts(classes.size() + 1);
  for (int v = 0; v < labels.labels.rows; ++v)
    for (int u = 0; u < labels.labels.cols; ++u)
      ++counts[std::min<std::size_t>(labels.labels.at<std::uint8_t>(v, u), classes.size())];
  json shares = json::object();
  for (std::size_t c = 0; c < counts.size(); ++c)
    if (counts[c] > 0)
      shares[c < classes.size() ? classes[c] : "none"] =
          static_cast<double>(counts[c]) / static_cast<double>(labels.labels.total());
  return shares;
}

/// The last keyframe up to a frame, else the first one.
KeyframeId keyframe_near(const Map& map, FrameId frame) {
  const auto after = std::ranges::upper_bound(map.keyframes, frame, {}, &Keyframe::frame);
  return after == map.keyframes.begin() ? map.keyframes.front().id : std::prev(after)->id;
}

/// Probability that the frame is in a street: as the run labelled its place, else by the images
/// and points of the keyframes around it.
double street_around(const StoredMap& stored, const Explanation& explanation,
                     const Dataset& dataset, const std::shared_ptr<const SceneModel>& surfaces) {
  const Place* place =
      explanation.posed ? stored.map.place_graph.find(*explanation.place) : nullptr;
  if (const auto kind = place ? environment_of(*place) : std::nullopt)
    return assumptions_of(*kind).street_surfaces ? 1 : 0;
  return street_probability(environment_around(
      stored.map, keyframe_near(stored.map, explanation.frame),
      dataset.calibration(stored.origin.sensor).camera, surfaces, [&](const Keyframe& keyframe) {
        return dataset.frame(static_cast<std::size_t>(keyframe.frame.value()),
                             stored.origin.sensor);
      }));
}

}  // namespace

json image_content(const StoredMap& stored, const Explanation& explanation) {
  const FrameId frame = explanation.frame;
  const std::string& sequence = stored.origin.sequence;
  if (sequence.empty() || !std::filesystem::exists(sequence))
    return {{"unknown", "the images are no longer at " + sequence}};
  SceneModel urban;
  std::shared_ptr<const SceneModel> surfaces;
  try {
    urban = load_scene_model(SceneModel::Kind::kUrban, "");
    surfaces =
        std::make_shared<const SceneModel>(load_scene_model(SceneModel::Kind::kSurfaces, ""));
  } catch (const FileError& error) {
    return {{"unknown", error.what()}};
  }
  const auto dataset = open_dataset(sequence);
  if (frame.value() >= static_cast<std::int64_t>(dataset->size()))
    return {{"unknown", sequence + " has " + std::to_string(dataset->size()) + " frames now"}};
  const Frame image = dataset->frame(static_cast<std::size_t>(frame.value()), stored.origin.sensor);
  const double street = street_around(stored, explanation, *dataset, surfaces);
  const StreetLabels labels = label_street_scene(
      urban, *surfaces, image.colour.empty() ? image.image : image.colour, street);
  return {{"surfaces", shares_of(labels.surfaces, surfaces->classes)},
          {"street", street},
          {"classes", shares_of(labels.classes, urban.classes)}};
}

}  // namespace placegraph::apps
