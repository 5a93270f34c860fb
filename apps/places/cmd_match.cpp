#include "apps/places/cmd_match.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/code_memory.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/measurements/loop_file.h>
#include <placegraph/io/models/vocabulary_file.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "apps/support/image_folder_of.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {

struct MatchOptions {
  PlaceRecognizerOptions recognizer;
  PlaceCodeOptions codes;
  SequenceFilterOptions sequence;
  void check() const;
};

void visit(OptionVisitor& field, MatchOptions& o) {
  field.group("recognizer", o.recognizer, "likeness of two views");
  field.group("codes", o.codes, "visual words");
  field.group("sequence", o.sequence, "evidence of past images");
}

void MatchOptions::check() const { check_ranges(*this); }

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kMatchCues = {"tiny", "colour", "gradients", "gabor", "corners"};

/// In the order of PlaceCode.
const std::vector<std::string> kCodes = {"bow", "bow_float", "llc", "landmarks"};
const char* const kMultiCue = "cues";

struct MatchArguments {
  std::string folder, out, codes = kMultiCue, vocabulary;
  std::vector<std::string> cues = kMatchCues;
  std::optional<int> min_age;
  bool sequence = false, force = false;
  std::vector<std::string> settings;
  MatchOptions options;
};

/// An image and the older ones it is compared with.
struct Query {
  int image = 0, first = 0, last = 0;
};

// Of the ground truth only who is compared with whom is taken.
std::vector<Query> listed_queries(const std::string& path, int images) {
  const LoopTruthFile file = read_loop_truth(path);
  if (file.format != LoopTruthFormat::kRanges)
    throw FileError(path, "lists no candidates (query first last ...): use --min-age");
  std::vector<Query> queries;
  for (const auto& [image, query] : file.truth.queries) {
    if (image >= images || query.last >= images)
      throw FileError(
          path, fmt::format("image {}, and there are {}", std::max(image, query.last), images));
    queries.push_back(
        {static_cast<int>(image), static_cast<int>(query.first), static_cast<int>(query.last)});
  }
  return queries;
}

std::vector<Query> queries_of(const MatchArguments& arguments, int images) {
  const std::string listed = (fs::path(arguments.folder) / "gt.txt").string();
  if (!arguments.min_age && fs::exists(listed)) return listed_queries(listed, images);
  constexpr int kMinAge = 300;
  const int min_age = arguments.min_age.value_or(kMinAge);
  std::vector<Query> queries;
  for (int image = min_age; image < images; ++image) queries.push_back({image, 0, image - min_age});
  require(!queries.empty(), fmt::format("{}: {} images, and none is {} older than another "
                                        "(see --min-age)",
                                        arguments.folder, images, min_age));
  return queries;
}

// Views are compared in colour only where all have it: the first says which it is to be.
Image view_of(const std::string& path, bool colour) {
  const GreyAndColour image = read_image(path);
  if (!colour) return image.grey;
  if (image.colour.empty()) throw FileError(path, "is grey, and the images before it have colour");
  return image.colour;
}

/// Answers which stored views an image resembles (the views `among`, if any), and stores it.
using LookUp =
    std::function<std::vector<PlaceLikeness>(const Image&, const std::optional<ViewRange>& among)>;

LookUp by_cues(const PlaceRecognizerOptions& options) {
  auto recognizer = std::make_shared<PlaceRecognizer>(options);
  return [recognizer](const Image& image, const std::optional<ViewRange>& among) {
    PlaceView view = describe_place(image, recognizer->options().cues, among.has_value());
    std::vector<PlaceLikeness> list;
    if (among) list = recognizer->query(view, among->first, among->last);
    recognizer->add(std::move(view));
    return list;
  };
}

LookUp by_codes(const MatchArguments& arguments) {
  const auto code = static_cast<PlaceCode>(
      std::find(kCodes.begin(), kCodes.end(), arguments.codes) - kCodes.begin());
  std::optional<WordTree> words;
  if (!arguments.vocabulary.empty()) words = read_vocabulary(arguments.vocabulary);
  require(words || code == PlaceCode::kBow,
          fmt::format("--codes {} needs a --vocabulary of --kind float", arguments.codes));
  const bool binary = code == PlaceCode::kBow;
  require(!words || (words->kind == WordTree::Kind::kBinary) == binary,
          fmt::format("{}: --codes {} needs a vocabulary of --kind {}", arguments.vocabulary,
                      arguments.codes, binary ? "binary" : "float"));
  constexpr std::uint64_t kSeed = 1;
  const std::shared_ptr<CodeMemory> memory =
      make_code_memory(code, arguments.options.codes, std::move(words), kSeed);
  return [memory](const Image& image, const std::optional<ViewRange>& among) {
    return memory->look_up_and_add(image, among);
  };
}

std::vector<LoopPrediction> match(const MatchArguments& arguments,
                                  const std::vector<std::string>& images,
                                  const std::vector<Query>& queries, bool colour,
                                  const LookUp& look_up) {
  SequenceFilter filter(arguments.options.sequence);
  std::vector<LoopPrediction> found;
  Progress progress("matching", static_cast<std::int64_t>(images.size()), "images");
  int before = -1;
  auto query = queries.begin();
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    std::optional<ViewRange> among;
    if (query != queries.end() && query->image == i) among = {query->first, query->last};
    const std::vector<PlaceLikeness> list =
        look_up(view_of(images[static_cast<std::size_t>(i)], colour), among);
    if (among) {
      std::optional<PlaceLikeness> answer;
      if (!list.empty()) answer = list.front();
      if (arguments.sequence) {
        if (i != before + 1) filter.restart();
        const auto paths = filter.update(list, among->first, std::min(among->last, i - 1));
        if (answer) {
          answer = paths.front();
          answer->score = filter.confidence(*answer, list);
        }
        before = i;
      }
      if (answer) found.push_back({i, answer->view, answer->score, {}, 0});
      ++query;
    }
    progress.update(i + 1);
  }
  return found;
}

void select_cues(MatchArguments& arguments) {
  const auto keep = [&](const char* name, double& weight) {
    if (std::find(arguments.cues.begin(), arguments.cues.end(), name) == arguments.cues.end())
      weight = 0;
  };
  PlaceCueOptions& cues = arguments.options.recognizer.cues;
  keep("tiny", cues.tiny);
  keep("colour", cues.colour);
  keep("gradients", cues.gradients);
  keep("gabor", cues.gabor);
  keep("corners", cues.corners);
}

void run(MatchArguments arguments) {
  require_free(arguments.out, arguments.force);
  for (const std::string& setting : arguments.settings) set_option(arguments.options, setting);
  arguments.options.check();
  select_cues(arguments);
  cv::setNumThreads(1);
  const std::vector<std::string> images = list_images(image_folder_of(arguments.folder));
  const std::vector<Query> queries = queries_of(arguments, static_cast<int>(images.size()));
  const bool by_words = arguments.codes != kMultiCue;
  const bool colour = !by_words && !read_image(images.front()).colour.empty();
  const LookUp look_up = by_words ? by_codes(arguments) : by_cues(arguments.options.recognizer);
  if (!colour && !by_words)
    warn(arguments.folder + ": grey images; places are told without the colour cue");
  const Stopwatch watch;
  const std::vector<LoopPrediction> found = match(arguments, images, queries, colour, look_up);
  if (found.empty())
    throw NoAnswer(arguments.folder + (by_words
                                           ? ": no image has a word in common with an older one"
                                           : ": no image has an older one to compare with"));
  write_loop_predictions(arguments.out, found);
  if (found.size() < queries.size())
    warn(fmt::format("{}: {} of {} queries have no answer, and no line", arguments.folder,
                     queries.size() - found.size(), queries.size()));
  fmt::print("{} images, {} queries, {:.1f} ms CPU an image, written to {}\n", images.size(),
             found.size(), watch.cpu_ms() / static_cast<double>(images.size()), arguments.out);
}

}  // namespace

void add_match_command(CLI::App& app) {
  auto arguments = std::make_shared<MatchArguments>();
  MatchArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("match", "Find for each image the older one that shows the same place");
  command->footer("placegraph match places/corridor --out found.txt --sequence");
  command
      ->add_option(
          "DIR", a.folder,
          "a folder of images, or one with them in images/ or image_0/; gt.txt there names "
          "the candidates of each query")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write `query candidate score`, one line per query")
      ->required();
  command->add_flag("--sequence", a.sequence, "add the evidence of the images before each query");
  command
      ->add_option("--min-age", a.min_age,
                   "compare every image with those at least so many older, whatever gt.txt says; "
                   "300 without one")
      ->check(CLI::Range(1, 1'000'000'000));
  command->add_option("--cues", a.cues, "tiny, colour, gradients, gabor, corners: those that count")
      ->delimiter(',')
      ->check(CLI::IsMember(kMatchCues))
      ->default_str("all");
  std::vector<std::string> codes = kCodes;
  codes.insert(codes.begin(), kMultiCue);
  command
      ->add_option("--codes", a.codes,
                   "what is compared: all cues, or visual words as bag (binary, SIFT), LLC, or "
                   "LLC of landmarks")
      ->check(CLI::IsMember(codes))
      ->capture_default_str();
  command
      ->add_option("--vocabulary", a.vocabulary,
                   "words made by `vocabulary train`; bow learns its own without one")
      ->check(CLI::ExistingFile);
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
