#include "apps/places/classify_places.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/loops/loop_file.h>
#include "apps/support/label_file.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "apps/support/choice.h"
#include "apps/support/output.h"

namespace placegraph::apps {

const std::vector<std::string>& place_machines() {
  static const std::vector<std::string> names = {"kernel", "svm", "adaboost"};
  return names;
}

const std::vector<std::string>& place_cues() {
  static const std::vector<std::string> names = {"colours", "quarters", "edges", "tiny", "gabor"};
  return names;
}

namespace {

namespace fs = std::filesystem;

struct Halves {
  std::set<FrameId> training, asked;
};

// The candidates of gt.txt are the training half, its queries the other.
Halves halves_of(const ClassifyPlacesArguments& arguments, int images) {
  Halves halves;
  const std::string listed = (fs::path(arguments.folder) / "gt.txt").string();
  if (arguments.train) {
    require(*arguments.train < images,
            fmt::format("--train {}: there are {} images", *arguments.train, images));
    for (int i = 0; i < images; ++i)
      (i < *arguments.train ? halves.training : halves.asked).insert(FrameId(i));
    return halves;
  }
  const LoopTruthFile file = read_loop_truth(listed);
  if (file.format != LoopTruthFormat::kRanges)
    throw FileError(listed, "lists no candidates (query first last ...): use --train");
  for (const auto& [image, query] : file.truth.queries) {
    if (image.value() >= images || query.last.value() >= images)
      throw FileError(listed, fmt::format("image {}, and there are {}",
                                          std::max(image, query.last).value(), images));
    halves.asked.insert(image);
    for (FrameId i = query.first; i <= query.last; ++i) halves.training.insert(i);
  }
  for (const FrameId image : halves.asked)
    require(!halves.training.contains(image),
            fmt::format("{}: image {} is a query and a candidate", listed, image.value()));
  return halves;
}

bool counts(const std::vector<std::string>& cues, const std::string& name) {
  return std::find(cues.begin(), cues.end(), name) != cues.end();
}

PlaceCueVectors read_view(const std::string& path, const std::vector<std::string>& cues) {
  const GreyAndColour image = read_image(path);
  PlaceCueVectors view = describe_for_classes(image.colour.empty() ? image.grey : image.colour);
  for (std::size_t m = 0; m < view.size(); ++m)
    if (!counts(cues, place_cues()[m])) view[m].resize(0);
  return view;
}

void require_some_cue(const ClassifyPlacesArguments& arguments, const PlaceCueVectors& view) {
  const auto known = [](const Eigen::VectorXf& cue) { return cue.size() > 0; };
  require(std::any_of(view.begin(), view.end(), known),
          arguments.folder + ": grey images, and --appearance asks for colours alone");
  const bool asked = counts(arguments.cues, "colours") || counts(arguments.cues, "quarters");
  if (asked && !known(view[0]) && !known(view[1]))
    warn(arguments.folder + ": grey images; the colour cues are not used");
}

/// Describes the views of the training half.
struct LabelledViews {
  std::vector<PlaceCueVectors> views;
  std::vector<int> labels;
};

LabelledViews read_training_set(const ClassifyPlacesArguments& arguments,
                                const std::vector<std::string>& images,
                                const std::set<FrameId>& training) {
  const std::string label_path = (fs::path(arguments.folder) / "labels.txt").string();
  const std::map<FrameId, int> all_labels = read_labels(label_path);
  LabelledViews training_set;
  for (const FrameId image : training) {
    const auto label = all_labels.find(image);
    if (label == all_labels.end())
      throw FileError(label_path, fmt::format("no label for training image {}", image.value()));
    constexpr int kMostPlaces = 10000;
    if (label->second >= kMostPlaces)
      throw FileError(label_path,
                      fmt::format("label {}: at most {} places", label->second, kMostPlaces));
    training_set.labels.push_back(label->second);
    training_set.views.push_back(
        read_view(images[static_cast<std::size_t>(image.value())], arguments.cues));
  }
  require_some_cue(arguments, training_set.views.front());
  return training_set;
}

std::vector<ClassifiedPlace> classify(const ClassifyPlacesArguments& arguments,
                                      const std::vector<std::string>& images,
                                      const std::set<FrameId>& asked,
                                      const PlaceClassifier& classifier, LabelFilter filter) {
  std::vector<ClassifiedPlace> predictions;
  for (const FrameId image : asked) {
    Eigen::VectorXd probabilities = classifier.classify(
        read_view(images[static_cast<std::size_t>(image.value())], arguments.cues));
    if (arguments.sequence) probabilities = filter.update(probabilities);
    Eigen::Index best = 0;
    const double probability = probabilities.maxCoeff(&best);
    const bool accepted =
        probability >= arguments.reject && entropy_share(probabilities) <= arguments.max_entropy;
    predictions.push_back({image, accepted ? static_cast<int>(best) : -1, probability});
  }
  return predictions;
}

}  // namespace

ClassifyPlacesResult classify_places(const ClassifyPlacesArguments& arguments) {
  PlaceClassifierOptions options;
  options.machine =
      choice<PlaceMachineKind>("--classifier", place_machines(), arguments.classifier);
  for (const std::string& cue : arguments.cues)
    (void)choice<int>("--appearance", place_cues(), cue);
  require_free(arguments.out, arguments.force);
  const fs::path inside = fs::path(arguments.folder) / "images";
  const std::vector<std::string> images =
      list_images(fs::is_directory(inside) ? inside.string() : arguments.folder);
  const Halves halves = halves_of(arguments, static_cast<int>(images.size()));
  LabelledViews training_set = read_training_set(arguments, images, halves.training);
  const PlaceClassifier classifier =
      PlaceClassifier::train(std::move(training_set.views), training_set.labels, options);
  ClassifyPlacesResult result;
  result.out = arguments.out;
  result.learned = training_set.labels.size();
  result.predictions =
      classify(arguments, images, halves.asked, classifier, LabelFilter(training_set.labels));
  std::string lines;
  for (const ClassifiedPlace& place : result.predictions) {
    result.refused += place.label < 0;
    lines += fmt::format("{} {} {:.6f}\n", place.image.value(), place.label, place.probability);
  }
  write_file(arguments.out, lines);
  result.weights = {classifier.weights().begin(), classifier.weights().end()};
  result.accuracy = classifier.cross_validated_accuracy();
  result.log_loss = classifier.cross_validated_log_loss();
  return result;
}

std::string to_text(const ClassifyPlacesResult& result) {
  std::string weights;
  for (std::size_t m = 0; m < result.weights.size(); ++m)
    weights += fmt::format("{}{} {:.2g}", m == 0 ? "" : ", ", place_cues()[m], result.weights[m]);
  return fmt::format(
      "{} training views, {} predictions, {} rejected; weights of {}; cross-validated accuracy "
      "{:.3f}, "
      "log loss {:.3f}; written to {}\n",
      result.learned, result.predictions.size(), result.refused, weights, result.accuracy,
      result.log_loss, result.out);
}

}  // namespace placegraph::apps
