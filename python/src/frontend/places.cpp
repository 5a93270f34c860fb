#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <mutex>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// A recognizer that several threads of Python may use. The lock is taken without the GIL, which
/// who holds the lock may ask for.
class SharedRecognizer {
 public:
  explicit SharedRecognizer(const OptionsArgument<PlaceRecognizerOptions>& options)
      : recognizer_(options.get()) {}

  int add(const nb::object& image) {
    std::optional<PlaceView> view = description_in(image);
    const Image picture = view ? Image() : PictureArgument{image}.get("image");
    const WithoutGil released;
    if (!view) view = described(picture, false);
    const std::lock_guard lock(mutex_);
    return recognizer_.add(std::move(*view));
  }

  std::vector<std::pair<int, double>> match(const nb::object& image, int first,
                                            std::optional<int> last, std::optional<int> count) {
    require(first >= 0, "first: it must not be negative");
    require(!last || *last >= -1, "last: it must not be below -1");
    require(!count || *count >= 0, "count: it must not be negative");
    std::optional<PlaceView> view = description_in(image);
    if (view) require_query(*view, "image");
    const Image picture = view ? Image() : PictureArgument{image}.get("image");
    std::vector<std::pair<int, double>> matches;
    const WithoutGil released;
    if (!view) view = described(picture, true);
    const std::lock_guard lock(mutex_);
    for (const PlaceSimilarity& each :
         recognizer_.query(*view, first, last.value_or(recognizer_.size() - 1))) {
      if (count && static_cast<int>(matches.size()) == *count) break;
      matches.emplace_back(each.view, each.score);
    }
    return matches;
  }

  PlaceView describe(const PictureArgument& image, bool query) const {
    const Image picture = image.get("image");
    const WithoutGil released;
    return described(picture, query);
  }

  double similarity(const nb::object& query, const nb::object& stored) const {
    std::optional<PlaceView> a = description_in(query), b = description_in(stored);
    if (a) require_query(*a, "query");
    const Image image_a = a ? Image() : PictureArgument{query}.get("query");
    const Image image_b = b ? Image() : PictureArgument{stored}.get("stored");
    const WithoutGil released;
    if (!a) a = described(image_a, true);
    if (!b) b = described(image_b, false);
    const PlaceCueOptions& cues = recognizer_.options().cues;
    return place_similarity(*a, *b, cues);
  }

  PlaceView view(int index) {
    const WithoutGil released;
    const std::lock_guard lock(mutex_);
    require(index >= 0 && index < recognizer_.size(),
            "index: there are " + std::to_string(recognizer_.size()) + " views");
    return recognizer_.view(index);
  }
  int size() {
    const WithoutGil released;
    const std::lock_guard lock(mutex_);
    return recognizer_.size();
  }

 private:
  static void require_query(const PlaceView& view, const char* argument) {
    require(view.tiny.size() != 1 && view.gradients.size() != 1,
            std::string(argument) + ": a description of a query is needed (query=True)");
  }
  static std::optional<PlaceView> description_in(const nb::object& image) {
    PlaceView view;
    return nb::try_cast(image, view) ? std::optional(std::move(view)) : std::nullopt;
  }
  PlaceView described(const Image& picture, bool query) const {
    return describe_place(picture, recognizer_.options().cues, query);
  }

  PlaceRecognizer recognizer_;
  std::mutex mutex_;
};

using Grid = std::optional<ReadOnlyArray<std::int16_t>>;

/// Vectors of the cells of a cue, rows x columns x channels; None if it was not computed.
Grid array_of_grid(const CueGrid& grid, const PlaceView& owner) {
  if (grid.empty()) return std::nullopt;
  const std::size_t shape[3] = {static_cast<std::size_t>(grid.rows),
                                static_cast<std::size_t>(grid.columns),
                                static_cast<std::size_t>(grid.channels)};
  return Grid(std::in_place, grid.values.data(), 3, shape, nb::find(owner));
}

/// That of the first scale.
Grid array_of_grid(const std::vector<CueGrid>& scales, const PlaceView& owner) {
  return scales.empty() ? std::nullopt : array_of_grid(scales.front(), owner);
}

/// The evidence of past images with recognizers' lists of indices and scores.
class PythonSequenceFilter {
 public:
  using List = std::vector<std::pair<int, double>>;

  explicit PythonSequenceFilter(const OptionsArgument<SequenceFilterOptions>& options)
      : filter_(options.get()) {}

  List update(const List& matches, int first, int last) {
    require(first >= 0, "first: it must not be negative");
    require(last - first < 1'000'000, "last: there are at most 1,000,000 views");
    List scores;
    for (const PlaceSimilarity& each : filter_.update(similarities(matches), first, last))
      scores.emplace_back(each.view, each.score);
    return scores;
  }
  double confidence(int index, double score, const List& matches) const {
    require(std::isfinite(score), "score: it is not finite");
    return filter_.confidence({index, score}, similarities(matches));
  }
  void restart() { filter_.restart(); }

 private:
  static std::vector<PlaceSimilarity> similarities(const List& matches) {
    std::vector<PlaceSimilarity> list;
    for (const auto& [index, score] : matches) {
      require(std::isfinite(score), "matches: a score is not finite");
      list.push_back({index, score});
    }
    return list;
  }

  SequenceFilter filter_;
};

void bind_view(nb::module_& m) {
  nb::class_<PlaceView>(m, "PlaceView", doc("PlaceView"))
      .def_prop_ro(
          "thumbnail", [](const PlaceView& v) { return view_of(v.thumbnail, v); },
          doc("PlaceView::thumbnail"))
      .def_prop_ro(
          "tiny", [](const PlaceView& v) { return array_of_grid(v.tiny, v); },
          "The small image, rows x columns x channels of int16; None if the cue has weight zero.")
      .def_prop_ro(
          "gradients", [](const PlaceView& v) { return array_of_grid(v.gradients, v); },
          "Histograms of gradient orientation, rows x columns x channels of int16, or None.")
      .def_prop_ro(
          "colour", [](const PlaceView& v) { return array_of_grid(v.colour, v); },
          doc("PlaceView::colour"))
      .def_prop_ro(
          "gabor", [](const PlaceView& v) { return array_of_grid(v.gabor, v); },
          doc("PlaceView::gabor"))
      .def_prop_ro(
          "corners", [](const PlaceView& v) { return v.corners.size(); }, "Number of corners.");
}

void bind_sequence_filter(nb::module_& m) {
  bind_option_set<SequenceFilterOptions>(m, "SequenceFilterOptionSet",
                                         doc("SequenceFilterOptions"));
  nb::class_<PythonSequenceFilter>(m, "SequenceFilter", doc("SequenceFilter"))
      .def(nb::init<const OptionsArgument<SequenceFilterOptions>&>(), "options"_a = nb::none(),
           "Starts without past images.")
      .def("update", &PythonSequenceFilter::update, "matches"_a, "first"_a, "last"_a,
           "Adds the next image's similarities; returns a score for every view in first..last.\n\n"
           "`matches` are pairs of a view and its score, of views in first..last (ArgumentError "
           "otherwise); a view that is not listed gets the score of the least similar listed one. "
           "The result is sorted by score, best first. Without matches the sequence ends, and the "
           "result is empty.")
      .def(
          "confidence", &PythonSequenceFilter::confidence, "index"_a, "score"_a, "matches"_a,
          "The confidence of a prediction of `update` (a view and its score), comparable over "
          "images.\n\n"
          "It is the weighted mean of the prediction's score and of the similarity of its view in "
          "`matches`, which `update` received, sorted best first. The reason: a path continues for "
          "some images after the camera has left its street. The choice of the best view does not "
          "change.")
      .def("restart", &PythonSequenceFilter::restart, doc("SequenceFilter::restart"));
}

}  // namespace

void bind_places(nb::module_& m) {
  bind_option_set<PlaceRecognizerOptions>(m, "PlaceRecognizerOptionSet",
                                          doc("PlaceRecognizerOptions"));
  bind_view(m);
  bind_sequence_filter(m);
  nb::class_<SharedRecognizer>(m, "PlaceRecognizer", doc("PlaceRecognizer"))
      .def(nb::init<const OptionsArgument<PlaceRecognizerOptions>&>(), "options"_a = nb::none(),
           "Starts without views.")
      .def("add", &SharedRecognizer::add, "image"_a,
           "Adds an image (H x W, or H x W x 3 BGR, uint8), or what `describe` returned, and "
           "returns its index: 0, 1, 2, ...\n\nImages are all grey or all in colour.",
           nb::sig("def add(self, image: numpy.typing.NDArray[numpy.uint8] | PlaceView) -> int"))
      .def("match", &SharedRecognizer::match, "image"_a, "first"_a = 0, "last"_a = nb::none(),
           "count"_a = nb::none(),
           "The most similar views among `first` to `last` (both included; all), best first: their "
           "indices and scores, at most `count`.\n\nA score is comparable over images, but no "
           "probability. A description must be one of a query.",
           nb::sig("def match(self, image: numpy.typing.NDArray[numpy.uint8] | PlaceView, first: "
                   "int = 0, last: int | None = None, count: int | None = None) -> list[tuple[int, "
                   "float]]"))
      .def(
          "describe", &SharedRecognizer::describe, "image"_a, "query"_a = false,
          "Describes the appearance of an image (H x W, or H x W x 3 BGR, uint8) by all cues whose "
          "weight is not 0.\n\nA `query`, which `match` needs, is described at three scales "
          "instead of one.")
      .def("similarity", &SharedRecognizer::similarity, "query"_a, "stored"_a,
           "The score of two images (or descriptions, the first of a query) by all cues, as "
           "`match` computes it for the views that it compares in full.",
           nb::sig("def similarity(self, query: numpy.typing.NDArray[numpy.uint8] | PlaceView, "
                   "stored: numpy.typing.NDArray[numpy.uint8] | PlaceView) -> float"))
      .def("view", &SharedRecognizer::view, "index"_a, "The description of a stored view.")
      .def("__len__", &SharedRecognizer::size);
}

}  // namespace placegraph::python
