#include "python/src/pipeline/recognizer.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include "python/src/graph/images.h"

namespace placegraph::python {
namespace {

/// One pair of an answer.
PlaceSimilarity similarity_of(nb::handle pair) {
  std::pair<int, double> value;
  if (!nb::try_cast(pair, value))
    throw ArgumentError(fmt::format("recognizer: query must return pairs (view, score), not {}",
                                    nb::cast<std::string>(nb::repr(pair))));
  return {value.first, value.second};
}

}  // namespace

PythonRecognizer::PythonRecognizer(nb::object object) : object_(std::move(object)) {
  for (const char* method : {"clear", "add", "query"})
    if (!nb::hasattr(object_, method) || PyCallable_Check(object_.attr(method).ptr()) == 0)
      throw ArgumentError(fmt::format("recognizer: it has no method {}", method));
}

void PythonRecognizer::clear() {
  const nb::gil_scoped_acquire gil;
  require(object_.is_valid(), "recognizer: it is gone");
  object_.attr("clear")();
}

void PythonRecognizer::add(const Image& image) {
  const nb::gil_scoped_acquire gil;
  require(object_.is_valid(), "recognizer: it is gone");
  object_.attr("add")(array_of(image, Access::kReadOnly));
}

std::vector<PlaceSimilarity> PythonRecognizer::query(const Image& image, int first, int last) {
  const nb::gil_scoped_acquire gil;
  require(object_.is_valid(), "recognizer: it is gone");
  const nb::object answer = object_.attr("query")(array_of(image, Access::kReadOnly), first, last);
  if (!nb::hasattr(answer, "__iter__"))
    throw ArgumentError(
        fmt::format("recognizer: query must return a list of pairs (view, score), not {}",
                    nb::cast<std::string>(nb::repr(answer))));
  std::vector<PlaceSimilarity> result;
  for (nb::handle pair : answer) result.push_back(similarity_of(pair));
  return result;
}

std::shared_ptr<PythonRecognizer> recognizer_of(const nb::object& object) {
  return object.is_none() ? nullptr : std::make_shared<PythonRecognizer>(object);
}

}  // namespace placegraph::python
