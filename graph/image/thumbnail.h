#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace placegraph {

/// A JPEG of a grey or BGR image of 8 bits, of at most 160 pixels at its longer side.
std::string thumbnail_of(const Image& image);

}  // namespace placegraph
