#pragma once
#include <placegraph/frontend/places/place_recognizer.h>

#include <memory>

#include "python/src/bindings.h"

namespace placegraph::python {

/// A place recognizer written in Python: an object with the methods clear(), add(image) and
/// query(image, first, last), which returns pairs (view, score).
class PythonRecognizer : public PlaceRetrieval {
 public:
  /// Throws ArgumentError for an object that lacks one of the methods.
  explicit PythonRecognizer(nb::object object);
  const nb::object& object() const { return object_; }
  /// Drops the object; later calls throw ArgumentError.
  void release() { object_.reset(); }

  void clear() override;
  void add(const Image& image) override;
  std::vector<PlaceSimilarity> query(const Image& image, int first, int last) override;

 private:
  nb::object object_;
};

/// The recognizer of an argument; null for None.
std::shared_ptr<PythonRecognizer> recognizer_of(const nb::object& object);

}  // namespace placegraph::python
