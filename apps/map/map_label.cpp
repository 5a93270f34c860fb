#include "apps/map/map_label.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/pipeline/map/map_file.h>
#include "apps/support/label_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "apps/support/image_range.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const Image& image_of(const Frame& frame, bool colour) {
  return colour ? frame.colour : frame.image;
}

/// Views are compared part by part, so all must have the same shape.
Image sized(const Image& image, const cv::Size& size) {
  Image result;
  cv::resize(image, result, size, 0, 0, cv::INTER_AREA);
  return result;
}

/// True if the text is UTF-8 without control characters.
bool is_text(const std::string& line) {
  try {
    (void)json(line).dump();
  } catch (const json::exception&) {
    return false;
  }
  return std::none_of(line.begin(), line.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

/// Names from a file, one per line, the first of label 0.
std::vector<std::string> read_names(const std::string& path) {
  require_input_file(path);
  std::ifstream file(path);
  if (!file) throw FileError(path, "cannot be read");
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const int number = static_cast<int>(names.size()) + 1;
    if (line.empty()) throw FileError(path, number, "an empty name");
    if (!is_text(line)) throw FileError(path, number, "is no UTF-8 text");
    names.push_back(line);
  }
  return names;
}

/// Images of a map's keyframes, from the sequence of the map.
std::function<Frame(const Keyframe&)> frames_of(const StoredMap& stored) {
  if (!stored.origin.calibration) {
    const ImageRange images = images_of(stored.origin.sequence, {});
    const std::int64_t count = static_cast<std::int64_t>(images.paths.size());
    for (const Keyframe& keyframe : stored.map.keyframes)
      if (keyframe.frame.value() >= count)
        throw FileError(stored.origin.sequence,
                        fmt::format("has {} images, and keyframe {} of the map is of image {}",
                                    count, keyframe.id.value(), keyframe.frame.value()));
    return [images](const Keyframe& keyframe) {
      return read_frame(images, static_cast<std::size_t>(keyframe.frame.value()));
    };
  }
  const std::shared_ptr<Dataset> dataset = open_dataset(stored.origin.sequence);
  return [dataset, sensor = stored.origin.sensor](const Keyframe& keyframe) {
    return dataset->frame(static_cast<std::size_t>(keyframe.frame.value()), sensor);
  };
}

PlaceClassifier learn(const MapLabelArguments& arguments, bool colour, int& places,
                      cv::Size& size) {
  const std::string path = (fs::path(arguments.house) / "labels.txt").string();
  const ImageRange images = images_of(arguments.house, arguments.range);
  const auto known = read_labels(path);
  std::vector<PlaceCueVectors> views;
  std::vector<int> labels;
  for (std::size_t i = 0; i < images.paths.size(); ++i) {
    const auto label = known.find(FrameId(images.first + static_cast<std::int64_t>(i)));
    if (label == known.end()) continue;
    const Frame frame = read_frame(images, i);
    if (colour && frame.colour.empty())
      throw FileError(images.paths[i], "is grey, and the map's images have colour");
    if (size.empty()) size = frame.image.size();
    views.push_back(describe_for_classes(sized(image_of(frame, colour), size)));
    labels.push_back(label->second);
  }
  if (labels.empty()) throw FileError(path, "labels none of the images");
  places = *std::max_element(labels.begin(), labels.end()) + 1;
  constexpr int kMostPlaces = 10000;
  if (places > kMostPlaces)
    throw FileError(path, fmt::format("label {}: at most {} places", places - 1, kMostPlaces));
  return PlaceClassifier::train(std::move(views), labels, PlaceClassifierOptions());
}

/// Sets the label of a place; returns the place with its label as JSON.
json relabelled(const PlaceLabel& of, const std::vector<std::string>& names, Place& place) {
  std::vector<std::string>& written = place.labels;
  written.clear();
  if (of.label)
    written.push_back(names.empty() ? std::to_string(*of.label)
                                    : names[static_cast<std::size_t>(*of.label)]);
  return {{"place", of.place},
          {"label", written.empty() ? json(nullptr) : json(written.front())},
          {"probability", of.probability},
          {"views", of.views}};
}

}  // namespace

MapLabelResult map_label(const MapLabelArguments& arguments) {
  arguments.options.check();
  StoredMap stored = read_map(map_path_of(arguments.map));
  Map& map = stored.map;
  if (!stored.finished)
    throw NoResult(arguments.map +
                   ": its run was broken off; finish it with `placegraph run --resume` first");
  if (map.keyframes.empty()) throw NoResult(arguments.map + ": has no keyframes");
  const auto frame_of = frames_of(stored);
  const bool colour = !frame_of(map.keyframes.front()).colour.empty();
  int places = 0;
  cv::Size size;
  const PlaceClassifier classifier = learn(arguments, colour, places, size);
  std::vector<std::string> names;
  if (!arguments.names.empty()) names = read_names(arguments.names);
  require(names.empty() || static_cast<int>(names.size()) >= places,
          fmt::format("--names: {} names for {} labels", names.size(), places));
  const std::vector<PlaceLabel> labels = label_places(
      map, classifier,
      [&](const Keyframe& keyframe) { return sized(image_of(frame_of(keyframe), colour), size); },
      arguments.options);
  MapLabelResult result;
  result.map = map_path_of(arguments.map);
  result.places = labels.size();
  result.views = map.keyframes.size();
  result.accuracy = classifier.cross_validated_accuracy();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    result.list.push_back(relabelled(labels[i], names, map.place_graph.places[i]));
    result.labelled += labels[i].label.has_value();
  }
  write_map(result.map, stored);
  return result;
}

std::string to_text(const MapLabelResult& result) {
  return fmt::format("{}: {} of {} places labelled ({} views; cross-validated accuracy {:.3f})\n",
                     result.map, result.labelled, result.places, result.views, result.accuracy);
}

std::string to_json(const MapLabelResult& result) {
  return json_text(json{{"places", result.list}}, 1);
}

}  // namespace placegraph::apps
