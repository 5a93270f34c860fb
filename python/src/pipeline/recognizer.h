#pragma once
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/recognition_options.h>

#include <memory>
#include <string>

#include "python/src/bindings.h"

namespace placegraph::python {

/// An object of Python that code without the GIL calls.
class HeldObject {
 public:
  explicit HeldObject(nb::object object) : object_(std::move(object)) {}
  virtual ~HeldObject() = default;
  const nb::object& object() const { return object_; }
  /// Drops the object; later calls throw ArgumentError.
  void release() { object_.reset(); }

 protected:
  /// The object; throws ArgumentError if it was dropped. Called with the GIL.
  const nb::object& present() const;

 private:
  nb::object object_;
};

/// A recognizer that an argument names or is.
struct OwnRecognizer {
  std::shared_ptr<PlaceRetrieval> retrieval;  ///< null: none
  std::shared_ptr<HeldObject> held;           ///< the object of Python in it, if there is one
  std::string name;                           ///< by which a saved map names it; empty: none
};

/// The recognizer of an argument: a name of open_describer, an object with the methods clear(),
/// add(image) and query(image, first, last), or a function from an image to a vector.
/// Throws ArgumentError for another object, and as open_describer.
OwnRecognizer recognizer_of(const nb::object& object, const DescriberOptions& options = {});

}  // namespace placegraph::python
