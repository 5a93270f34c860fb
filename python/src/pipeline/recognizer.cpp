#include "python/src/pipeline/recognizer.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/descriptors/image_describer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>

#include <algorithm>

#include "python/src/arrays.h"
#include "python/src/eval/loop_columns.h"
#include "python/src/graph/images.h"

namespace placegraph::python {
namespace {

std::string repr_of(nb::handle object) { return nb::cast<std::string>(nb::repr(object)); }

bool has_method(nb::handle object, const char* name) {
  return nb::hasattr(object, name) && PyCallable_Check(object.attr(name).ptr()) != 0;
}

/// One pair of an answer.
PlaceSimilarity similarity_of(nb::handle pair) {
  std::pair<int, double> value;
  if (!nb::try_cast(pair, value))
    throw ArgumentError(
        fmt::format("recognizer: query must return pairs (view, score), not {}", repr_of(pair)));
  return {value.first, value.second};
}

/// A place recognizer written in Python: an object with the methods clear(), add(image) and
/// query(image, first, last), which returns pairs (view, score).
class PythonRecognizer : public PlaceRetrieval, public HeldObject {
 public:
  using HeldObject::HeldObject;

  void clear() override {
    const nb::gil_scoped_acquire gil;
    present().attr("clear")();
  }
  void add(const Image& image) override {
    const nb::gil_scoped_acquire gil;
    present().attr("add")(array_of(image, Access::kReadOnly));
  }
  std::vector<PlaceSimilarity> query(const Image& image, int first, int last) override {
    const nb::gil_scoped_acquire gil;
    const nb::object answer =
        present().attr("query")(array_of(image, Access::kReadOnly), first, last);
    if (!nb::hasattr(answer, "__iter__"))
      throw ArgumentError(fmt::format(
          "recognizer: query must return a list of pairs (view, score), not {}", repr_of(answer)));
    std::vector<PlaceSimilarity> result;
    for (nb::handle pair : answer) result.push_back(similarity_of(pair));
    return result;
  }
};

/// A function of Python from an image to a vector.
class PythonDescriber : public ImageDescriber, public HeldObject {
 public:
  using HeldObject::HeldObject;

  std::vector<float> describe(const Image& image, FrameId) override {
    const nb::gil_scoped_acquire gil;
    const nb::object answer = present()(array_of(image, Access::kReadOnly));
    std::vector<float> values;
    // An array of any kind of numbers becomes a list of floats.
    const nb::object list = nb::hasattr(answer, "tolist") ? answer.attr("tolist")() : answer;
    if (!nb::try_cast(list, values))
      throw ArgumentError(
          fmt::format("recognizer: it must return a vector of numbers, not {}", repr_of(answer)));
    return values;
  }
};

/// The best older image of each image, as columns query, candidate and score.
Table match_images(const nb::iterable& images, const nb::object& recognizer, int min_age) {
  require(min_age >= 1, "min_age: at least 1 is needed");
  const OwnRecognizer own = recognizer_of(recognizer);
  require(own.retrieval != nullptr, "recognizer: there is none");
  std::vector<LoopPrediction> predictions;
  int i = 0;
  for (nb::handle each : images) {
    const bool colour = nb::hasattr(each, "ndim") && nb::cast<int>(each.attr("ndim")) == 3;
    const Image image = colour ? colour_image(each, "images") : grey_image(each, "images");
    const WithoutGil released;
    if (i == 0) own.retrieval->clear();
    own.retrieval->begin_frame(FrameId(i));
    std::vector<PlaceSimilarity> list;
    if (i >= min_age) list = own.retrieval->query(image, 0, i - min_age);
    const auto best = std::ranges::max_element(list, {}, &PlaceSimilarity::score);
    if (best != list.end())
      predictions.push_back({FrameId(i), FrameId(best->view), best->score, {}, 0});
    own.retrieval->add(image);
    ++i;
  }
  return columns_of(predictions);
}

}  // namespace

void bind_recognizers(nb::module_& m) {
  using namespace nb::literals;
  m.def("match_images", &match_images, "images"_a, "recognizer"_a.none(), "min_age"_a,
        "The best older image of each image, as columns query, candidate and score.");
}

const nb::object& HeldObject::present() const {
  require(object_.is_valid(), "recognizer: it is gone");
  return object_;
}

OwnRecognizer recognizer_of(const nb::object& object, const DescriberOptions& options) {
  if (object.is_none()) return {};
  if (std::string name; nb::isinstance<nb::str>(object) && nb::try_cast(object, name))
    return {make_recognizer(open_describer(name, options), options, {}), nullptr, name};
  const std::string name = "python:" + nb::cast<std::string>(nb::type_name(object.type()));
  const bool function = PyCallable_Check(object.ptr()) != 0;
  if (function && !has_method(object, "query")) {
    const auto describer = std::make_shared<PythonDescriber>(object);
    return {make_recognizer(describer, options, {}), describer, name};
  }
  for (const char* method : {"clear", "add", "query"})
    if (!has_method(object, method))
      throw ArgumentError(fmt::format("recognizer: it has no method {}", method));
  const auto recognizer = std::make_shared<PythonRecognizer>(object);
  return {recognizer, recognizer, name};
}

}  // namespace placegraph::python
