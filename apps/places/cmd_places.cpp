#include "apps/places/cmd_places.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/measurements/label_file.h>
#include <placegraph/io/measurements/loop_file.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// In the order of PlaceMachineKind, and of PlaceCueVectors.
const std::vector<std::string> kMachines = {"kernel", "svm", "adaboost"};
const std::vector<std::string> kPlaceCues = {"colours", "quarters", "edges", "tiny", "gabor"};

struct PlacesArguments {
  std::string folder, out;
  std::optional<int> train;
  double reject = 0, max_entropy = 1;
  std::string classifier = kMachines.front();
  std::vector<std::string> cues = kPlaceCues;
  bool sequence = false, force = false;
};

struct Halves {
  std::set<std::int64_t> training, asked;
};

// The candidates of gt.txt are the training half, its queries the other.
Halves halves_of(const PlacesArguments& arguments, int images) {
  Halves halves;
  const std::string listed = (fs::path(arguments.folder) / "gt.txt").string();
  if (arguments.train) {
    require(*arguments.train < images,
            fmt::format("--train {}: there are {} images", *arguments.train, images));
    for (int i = 0; i < images; ++i)
      (i < *arguments.train ? halves.training : halves.asked).insert(i);
    return halves;
  }
  const LoopTruthFile file = read_loop_truth(listed);
  if (file.format != LoopTruthFormat::kRanges)
    throw FileError(listed, "lists no candidates (query first last ...): use --train");
  for (const auto& [image, query] : file.truth.queries) {
    if (image >= images || query.last >= images)
      throw FileError(
          listed, fmt::format("image {}, and there are {}", std::max(image, query.last), images));
    halves.asked.insert(image);
    for (std::int64_t i = query.first; i <= query.last; ++i) halves.training.insert(i);
  }
  for (const std::int64_t image : halves.asked)
    require(!halves.training.contains(image),
            fmt::format("{}: image {} is a query and a candidate", listed, image));
  return halves;
}

PlaceCueVectors read_view(const std::string& path, const std::vector<std::string>& cues) {
  const GreyAndColour image = read_image(path);
  PlaceCueVectors view = describe_for_classes(image.colour.empty() ? image.grey : image.colour);
  for (std::size_t m = 0; m < view.size(); ++m)
    if (std::find(cues.begin(), cues.end(), kPlaceCues[m]) == cues.end()) view[m].resize(0);
  return view;
}

void require_some_cue(const PlacesArguments& arguments, const PlaceCueVectors& view) {
  const auto known = [](const Eigen::VectorXf& cue) { return cue.size() > 0; };
  require(std::any_of(view.begin(), view.end(), known),
          arguments.folder + ": grey images, and --cues asks for colours alone");
  const bool asked =
      std::find(arguments.cues.begin(), arguments.cues.end(), "colours") != arguments.cues.end() ||
      std::find(arguments.cues.begin(), arguments.cues.end(), "quarters") != arguments.cues.end();
  if (asked && !known(view[0]) && !known(view[1]))
    warn(arguments.folder + ": grey images; places are told without the colour cues");
}

void classify(const PlacesArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const fs::path inside = fs::path(arguments.folder) / "images";
  const std::vector<std::string> images =
      list_images(fs::is_directory(inside) ? inside.string() : arguments.folder);
  const Halves halves = halves_of(arguments, static_cast<int>(images.size()));
  const std::string label_path = (fs::path(arguments.folder) / "labels.txt").string();
  const std::map<std::int64_t, int> all_labels = read_labels(label_path);
  std::vector<PlaceCueVectors> views;
  std::vector<int> labels;
  for (const std::int64_t image : halves.training) {
    const auto label = all_labels.find(image);
    if (label == all_labels.end())
      throw FileError(label_path, fmt::format("no label for training image {}", image));
    constexpr int kMostPlaces = 10000;
    if (label->second >= kMostPlaces)
      throw FileError(label_path,
                      fmt::format("label {}: at most {} places", label->second, kMostPlaces));
    labels.push_back(label->second);
    views.push_back(read_view(images[static_cast<std::size_t>(image)], arguments.cues));
  }
  require_some_cue(arguments, views.front());
  PlaceClassifierOptions options;
  options.machine = static_cast<PlaceMachineKind>(
      std::find(kMachines.begin(), kMachines.end(), arguments.classifier) - kMachines.begin());
  const PlaceClassifier classifier = PlaceClassifier::train(std::move(views), labels, options);
  LabelFilter filter(labels);
  std::string lines;
  int refused = 0;
  for (const std::int64_t image : halves.asked) {
    Eigen::VectorXd probabilities =
        classifier.classify(read_view(images[static_cast<std::size_t>(image)], arguments.cues));
    if (arguments.sequence) probabilities = filter.update(probabilities);
    Eigen::Index best = 0;
    const double probability = probabilities.maxCoeff(&best);
    const bool accepted =
        probability >= arguments.reject && entropy_share(probabilities) <= arguments.max_entropy;
    refused += !accepted;
    lines +=
        fmt::format("{} {} {:.6f}\n", image, accepted ? static_cast<int>(best) : -1, probability);
  }
  write_file(arguments.out, lines);
  std::string weights;
  for (std::size_t m = 0; m < kPlaceCues.size(); ++m)
    weights +=
        fmt::format("{}{} {:.2g}", m == 0 ? "" : ", ", kPlaceCues[m], classifier.weights()[m]);
  fmt::print(
      "{} views learned, {} told, {} refused; weights of {}; on left out parts accuracy {:.3f}, "
      "log loss {:.3f}; written to {}\n",
      labels.size(), halves.asked.size(), refused, weights, classifier.cross_validated_accuracy(),
      classifier.cross_validated_log_loss(), arguments.out);
}

}  // namespace

void add_places_command(CLI::App& app) {
  CLI::App* places = app.add_subcommand("places", "Labelled places");
  places->footer("placegraph places classify house --out told.txt");
  places->require_subcommand(1);
  auto arguments = std::make_shared<PlacesArguments>();
  PlacesArguments& a = *arguments;
  CLI::App* command = places->add_subcommand(
      "classify", "Learn the labels of some images and tell those of the others");
  command->footer("placegraph places classify house --out told.txt --sequence");
  command
      ->add_option("DIR", a.folder,
                   "a folder with images/, labels.txt (`image label` a line) and gt.txt, whose "
                   "candidates are learned and whose queries are told")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write `image label probability`, label -1 where refused")
      ->required();
  command
      ->add_option("--train", a.train,
                   "learn the first so many images and tell the others, whatever "
                   "gt.txt says")
      ->check(CLI::Range(2, 1'000'000'000));
  command->add_option("--reject", a.reject, "refuse to tell below this probability")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--max-entropy", a.max_entropy,
                   "refuse to tell above this entropy, as a share of that of knowing nothing")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--classifier", a.classifier, "what learns the places")
      ->check(CLI::IsMember(kMachines))
      ->capture_default_str();
  command->add_option("--cues", a.cues, "colours, quarters, edges, tiny, gabor: those that count")
      ->delimiter(',')
      ->check(CLI::IsMember(kPlaceCues))
      ->default_str("all");
  command->add_flag("--sequence", a.sequence, "add the evidence of the images before each");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { classify(*arguments); });
}

}  // namespace placegraph::apps
