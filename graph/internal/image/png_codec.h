#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/internal/image/decoded_pixels.h>

#include <optional>
#include <string>
#include <string_view>

namespace placegraph {

/// Whether the bytes begin as a PNG does.
bool is_png(std::string_view bytes);

/// Whether the end mark of a PNG is missing.
bool is_truncated_png(std::string_view bytes);

/// Decodes a PNG of any kind; gives an empty image if the bytes are not a whole, intact one.
/// Palettes become colours, 1 to 4 bits become 8. With kAsStored transparency becomes alpha where
/// the file has colour. The pixels are those of OpenCV's imdecode.
Image decode_png(std::string_view bytes, DecodedPixels pixels);

/// How hard the encoder tries. By default it is quick: level 1, differences to the left neighbour,
/// runs of equal bytes.
struct PngCompression {
  std::optional<int> level;  ///< of zlib, 0 to 9: libpng chooses the filter of every row
  bool runs_only = false;    ///< with a level: look for runs of equal bytes alone
};

/// The bytes of a PNG file with these pixels: CV_8U or CV_16U, grey, BGR or BGRA.
/// They are those of OpenCV's imencode. Throws ArgumentError for another type or an empty image.
std::string encode_png(const Image& image, const PngCompression& compression = {});

}  // namespace placegraph
