#pragma once
#include <placegraph/graph/image/decoded_pixels.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <string>
#include <string_view>

namespace placegraph {

/// Whether the bytes begin as a PNG does.
bool is_png(std::string_view bytes);

/// Whether the end mark of a PNG is missing.
bool is_truncated_png(std::string_view bytes);

/// Decodes a PNG of any kind; returns an empty image if the bytes are not a complete, intact PNG.
/// Palettes are converted to colours, 1 to 4 bits to 8. With kAsStored transparency becomes alpha
/// if the file has colour. The pixels are those of OpenCV's imdecode.
Image decode_png(std::string_view bytes, DecodedPixels pixels);

/// Effort of the encoder. The default is fast: level 1, differences to the left neighbour, runs of
/// equal bytes.
struct PngCompression {
  std::optional<int> level;  ///< level of zlib, 0 to 9: libpng chooses the filter of every row
  bool runs_only = false;    ///< with a level: search for runs of equal bytes only
};

/// The bytes of a PNG file with these pixels: CV_8U or CV_16U, grey, BGR or BGRA.
/// They are those of OpenCV's imencode. Throws ArgumentError for another type or an empty image.
std::string encode_png(const Image& image, const PngCompression& compression = {});

}  // namespace placegraph
