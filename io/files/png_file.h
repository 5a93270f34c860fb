#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/image/png_codec.h>

#include <string>

namespace placegraph {

/// Writes a PNG file atomically, for any extension of `path`.
/// The image must be supported by encode_png(). Throws FileError.
void write_png(const std::string& path, const Image& image, const PngCompression& compression = {});

}  // namespace placegraph
