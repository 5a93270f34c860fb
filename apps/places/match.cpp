#include "apps/places/match.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/models/vocabulary_file.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "apps/support/choice.h"
#include "apps/support/image_range.h"
#include "apps/support/interruption.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {

void visit(OptionVisitor& field, MatchOptions& options) {
  field.group("recognizer", options.recognizer, "similarity of two views");
  field.group("codes", options.codes, "visual words");
  field.group("sequence", options.sequence, "evidence of past images");
  field.group("describer", options.describer, "recognizer that is not the library's");
}

void MatchOptions::check() const { check_ranges(*this); }

const std::vector<std::string>& match_codes() {
  static const std::vector<std::string> names = {"cues", "bow", "bow_float", "llc", "landmarks"};
  return names;
}

namespace {

namespace fs = std::filesystem;

/// An image and the range of older ones it is compared with.
struct MatchQuery {
  int image = 0, first = 0, last = 0;
};

// From the ground truth, only the candidates of each query are used.
std::vector<MatchQuery> listed_queries(const std::string& path, int images) {
  const LoopTruthFile file = read_loop_truth(path);
  if (file.format != LoopTruthFormat::kRanges)
    throw FileError(path, "lists no candidates (query first last ...): use --min-age");
  std::vector<MatchQuery> queries;
  for (const auto& [image, query] : file.truth.queries) {
    if (image.value() >= images || query.last.value() >= images)
      throw FileError(path, fmt::format("image {}, and there are {}",
                                        std::max(image, query.last).value(), images));
    queries.push_back({static_cast<int>(image.value()), static_cast<int>(query.first.value()),
                       static_cast<int>(query.last.value())});
  }
  return queries;
}

std::vector<MatchQuery> queries_of(const MatchArguments& arguments, int images) {
  const std::string listed = (fs::path(arguments.folder) / "gt.txt").string();
  if (!arguments.min_age && fs::exists(listed)) return listed_queries(listed, images);
  constexpr int kMinAge = 300;
  const int min_age = arguments.min_age.value_or(kMinAge);
  std::vector<MatchQuery> queries;
  for (int image = min_age; image < images; ++image) queries.push_back({image, 0, image - min_age});
  require(!queries.empty(), fmt::format("{}: {} images, and none is {} older than another "
                                        "(see --min-age)",
                                        arguments.folder, images, min_age));
  return queries;
}

// Views are compared in colour only if all have it; the first one decides.
Image compared_view(const std::string& path, bool colour) {
  const GreyAndColour image = read_image(path);
  if (!colour) return image.grey;
  if (image.colour.empty()) throw FileError(path, "is grey, and the images before it have colour");
  return image.colour;
}

/// Returns the stored views that resemble an image (among the views `among`, if given), and stores
/// it.
using Query = std::function<std::vector<PlaceSimilarity>(const Image&,
                                                         const std::optional<ViewRange>& among)>;

Query by_cues(const PlaceRecognizerOptions& options) {
  auto recognizer = std::make_shared<PlaceRecognizer>(options);
  return [recognizer](const Image& image, const std::optional<ViewRange>& among) {
    PlaceView view = describe_place(image, recognizer->options().cues, among.has_value());
    std::vector<PlaceSimilarity> list;
    if (among) list = recognizer->query(view, among->first, among->last);
    recognizer->add(std::move(view));
    return list;
  };
}

Query by_words(const MatchArguments& arguments, PlaceCode code) {
  std::optional<WordTree> words;
  if (!arguments.vocabulary.empty()) words = read_vocabulary(arguments.vocabulary);
  require(words || code == PlaceCode::kBow,
          fmt::format("--codes {} needs a --vocabulary of --kind float", arguments.codes));
  const bool binary = code == PlaceCode::kBow;
  require(!words || (words->kind == WordTree::Kind::kBinary) == binary,
          fmt::format("{}: --codes {} needs a vocabulary of --kind {}", arguments.vocabulary,
                      arguments.codes, binary ? "binary" : "float"));
  constexpr std::uint64_t kSeed = 1;
  const std::shared_ptr<CodeDatabase> memory =
      make_code_database(code, arguments.options.codes, std::move(words), kSeed);
  return [memory](const Image& image, const std::optional<ViewRange>& among) {
    return memory->find_and_add(image, among);
  };
}

Query by_recognizer(const MatchArguments& arguments) {
  const DescriberOptions& options = arguments.options.describer;
  const std::shared_ptr<PlaceRetrieval> recognizer = make_recognizer(
      open_describer(arguments.recognizer, options), options, arguments.options.recognizer);
  return [recognizer, image_number = 0](const Image& image,
                                        const std::optional<ViewRange>& among) mutable {
    recognizer->begin_frame(FrameId(image_number++));
    std::vector<PlaceSimilarity> list;
    if (among) list = recognizer->query(image, among->first, among->last);
    std::ranges::stable_sort(list, std::ranges::greater(), &PlaceSimilarity::score);
    recognizer->add(image);
    return list;
  };
}

/// The best match of each list, if desired with the evidence of the previous images.
class BestMatch {
 public:
  BestMatch(const SequenceFilterOptions& options, bool sequence)
      : filter_(options), sequence_(sequence) {}

  std::optional<PlaceSimilarity> of(const MatchQuery& query,
                                    const std::vector<PlaceSimilarity>& list) {
    std::optional<PlaceSimilarity> prediction;
    if (!list.empty()) prediction = list.front();
    if (!sequence_) return prediction;
    if (query.image != before_ + 1) filter_.restart();
    const auto paths = filter_.update(list, query.first, std::min(query.last, query.image - 1));
    if (prediction) {
      prediction = paths.front();
      prediction->score = filter_.confidence(*prediction, list);
    }
    before_ = query.image;
    return prediction;
  }

 private:
  SequenceFilter filter_;
  bool sequence_;
  int before_ = -1;
};

std::vector<LoopPrediction> matches_of(const MatchArguments& arguments,
                                       const std::vector<std::string>& images,
                                       const std::vector<MatchQuery>& queries, bool colour,
                                       const Query& find_and_add) {
  BestMatch best(arguments.options.sequence, arguments.sequence);
  std::vector<LoopPrediction> found;
  Progress progress("matching", static_cast<std::int64_t>(images.size()), "images");
  auto query = queries.begin();
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    check_interruption();
    std::optional<ViewRange> among;
    if (query != queries.end() && query->image == i) among = {query->first, query->last};
    const std::vector<PlaceSimilarity> list =
        find_and_add(compared_view(images[static_cast<std::size_t>(i)], colour), among);
    if (among) {
      if (const auto prediction = best.of(*query, list))
        found.push_back({FrameId(i), FrameId(prediction->view), prediction->score, {}, 0});
      ++query;
    }
    progress.update(i + 1);
  }
  return found;
}

/// The options of the command line, checked.
MatchArguments with_settings(MatchArguments arguments) {
  require_free(arguments.out, arguments.force);
  for (const std::string& setting : arguments.settings)
    set_option(arguments.options, setting, option_notes());
  require_no_recognizer(arguments.options.describer, "--set");
  if (!arguments.cues.empty()) {
    try {
      PlaceCueOptions& cues = arguments.options.recognizer.cues;
      cues = only_cues(cues, arguments.cues);
    } catch (const ArgumentError& error) {
      throw ArgumentError(std::string("--appearance: ") + error.what());
    }
    if (!arguments.recognizer.empty())
      arguments.options.describer.beside = fmt::format("{}", fmt::join(arguments.cues, ","));
  }
  arguments.options.check();
  return arguments;
}

}  // namespace

MatchResult match(const MatchArguments& asked) {
  const MatchArguments arguments = with_settings(asked);
  const int code = choice<int>("--codes", match_codes(), arguments.codes);
  const bool words = code > 0, foreign = !arguments.recognizer.empty();
  require(!words || !foreign, "--codes: --recognizer takes their place");
  cv::setNumThreads(1);
  const Interruption interruption;
  const InterruptionScope ends_the_work([&] {
    if (interruption.requested()) throw Interrupted("interrupted; nothing was written");
  });
  const std::vector<std::string> images = list_images(image_folder_of(arguments.folder));
  const std::vector<MatchQuery> queries = queries_of(arguments, static_cast<int>(images.size()));
  const bool colour = !words && !read_image(images.front()).colour.empty();
  const Query find_and_add = words     ? by_words(arguments, static_cast<PlaceCode>(code - 1))
                             : foreign ? by_recognizer(arguments)
                                       : by_cues(arguments.options.recognizer);
  if (!colour && !words && !foreign)
    warn(arguments.folder + ": grey images; the colour cue is not used");
  const Stopwatch watch;
  MatchResult result{arguments.out, images.size(), queries.size(),
                     matches_of(arguments, images, queries, colour, find_and_add)};
  const std::size_t found = result.found.size();
  if (found == 0)
    throw NoResult(arguments.folder + (words ? ": no image has a word in common with an older one"
                                             : ": no image has an older one to compare with"));
  write_loop_predictions(arguments.out, result.found);
  if (found < queries.size())
    warn(fmt::format("{}: {} of {} queries have no match, and no line", arguments.folder,
                     queries.size() - found, queries.size()));
  result.cpu_ms_an_image = watch.cpu_ms() / static_cast<double>(images.size());
  return result;
}

std::string to_text(const MatchResult& result) {
  return fmt::format("{} images, {} queries, {:.1f} ms CPU an image, written to {}\n",
                     result.images, result.found.size(), result.cpu_ms_an_image, result.out);
}

}  // namespace placegraph::apps
