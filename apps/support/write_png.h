#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/internal/image/png_codec.h>

#include <string>

namespace placegraph::apps {

/// Writes a PNG file, whatever the extension of `path`, as a whole or not at all.
/// The image is one that encode_png() takes. Throws FileError.
void write_png(const std::string& path, const Image& image, const PngCompression& compression = {});

}  // namespace placegraph::apps
