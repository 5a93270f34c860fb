#include "apps/cmd_match.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/image_file.h>
#include <placegraph/io/image_list.h>
#include <placegraph/io/loop_file.h>
#include <placegraph/io/yaml_config.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <opencv2/core/utility.hpp>

#include "apps/output.h"
#include "apps/progress.h"
#include "apps/usage.h"

namespace placegraph::apps {

struct MatchOptions {
  PlaceRecognizerOptions recognizer;
  SequenceFilterOptions sequence;
  void check() const;
};

void visit(OptionVisitor& field, MatchOptions& o) {
  field.group("recognizer", o.recognizer, "likeness of two views");
  field.group("sequence", o.sequence, "evidence of past images");
}

void MatchOptions::check() const { check_ranges(*this); }

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kCues = {"tiny", "colour", "gradients", "corners"};

struct Arguments {
  std::string folder, out;
  std::vector<std::string> cues = kCues;
  std::optional<int> min_age;
  bool sequence = false, force = false;
  std::vector<std::string> settings;
  MatchOptions options;
};

/// An image and the older ones it is compared with.
struct Query {
  int image = 0, first = 0, last = 0;
};

std::string image_folder_of(const std::string& folder) {
  for (const char* name : {"images", "image_0"})
    if (fs::is_directory(fs::path(folder) / name)) return (fs::path(folder) / name).string();
  return folder;
}

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

std::vector<Query> queries_of(const Arguments& arguments, int images) {
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

std::vector<LoopPrediction> match(const Arguments& arguments,
                                  const std::vector<std::string>& images,
                                  const std::vector<Query>& queries, bool colour) {
  const PlaceCueOptions& cues = arguments.options.recognizer.cues;
  PlaceRecognizer recognizer(arguments.options.recognizer);
  SequenceFilter filter(arguments.options.sequence);
  std::vector<LoopPrediction> found;
  Progress progress("matching", static_cast<std::int64_t>(images.size()), "images");
  int before = -1;
  auto query = queries.begin();
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    const bool asked = query != queries.end() && query->image == i;
    PlaceView view =
        describe_place(view_of(images[static_cast<std::size_t>(i)], colour), cues, asked);
    if (asked) {
      std::vector<PlaceLikeness> list = recognizer.query(view, query->first, query->last);
      if (arguments.sequence) {
        if (i != before + 1) filter.restart();
        list = filter.update(list, query->first, std::min(query->last, recognizer.size() - 1));
        before = i;
      }
      if (!list.empty()) found.push_back({i, list.front().view, list.front().score, {}, 0});
      ++query;
    }
    recognizer.add(std::move(view));
    progress.update(i + 1);
  }
  return found;
}

void select_cues(Arguments& arguments) {
  const auto keep = [&](const char* name, double& weight) {
    if (std::find(arguments.cues.begin(), arguments.cues.end(), name) == arguments.cues.end())
      weight = 0;
  };
  PlaceCueOptions& cues = arguments.options.recognizer.cues;
  keep("tiny", cues.tiny);
  keep("colour", cues.colour);
  keep("gradients", cues.gradients);
  keep("corners", cues.corners);
}

void run(Arguments arguments) {
  require_free(arguments.out, arguments.force);
  for (const std::string& setting : arguments.settings) set_option(arguments.options, setting);
  arguments.options.check();
  select_cues(arguments);
  cv::setNumThreads(1);
  const std::vector<std::string> images = list_images(image_folder_of(arguments.folder));
  const std::vector<Query> queries = queries_of(arguments, static_cast<int>(images.size()));
  const bool colour = !read_image(images.front()).colour.empty();
  if (!colour) warn(arguments.folder + ": grey images; places are told without the colour cue");
  const Stopwatch watch;
  const std::vector<LoopPrediction> found = match(arguments, images, queries, colour);
  if (found.empty())
    throw NoAnswer(arguments.folder + ": no image has an older one to compare with");
  write_loop_predictions(arguments.out, found);
  fmt::print("{} images, {} queries, {:.1f} ms CPU an image, written to {}\n", images.size(),
             found.size(), watch.cpu_ms() / static_cast<double>(images.size()), arguments.out);
}

}  // namespace

void add_match_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
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
  command->add_option("--cues", a.cues, "tiny, colour, gradients, corners: those that count")
      ->delimiter(',')
      ->check(CLI::IsMember(kCues))
      ->default_str("all");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
