#pragma once
#include <placegraph/graph/image/image.h>

#include "python/src/bindings.h"

namespace placegraph::python {

/// Whether an array may be written to; images of frames are shared, and must not.
enum class Access { kReadWrite, kReadOnly };

/// A view of the pixels as an array (H x W, or H x W x channels), which keeps the image alive; None
/// for an empty image. Nothing is copied.
nb::object array_of(const Image& image, Access access = Access::kReadOnly);

/// The pixels of an array as an image that shares and keeps them.
///
/// Grey: H x W uint8; colour: H x W x 3 uint8 in the order blue, green, red; depth: H x W float32
/// [m]; optical flow: H x W x 2 float32 (right, down) [px]. Rows must be contiguous. Throws
/// ArgumentError, which names the argument, otherwise.
Image grey_image(nb::handle array, const char* argument);
Image colour_image(nb::handle array, const char* argument);
Image depth_image(nb::handle array, const char* argument);
Image flow_image(nb::handle array, const char* argument);

}  // namespace placegraph::python
