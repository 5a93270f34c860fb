#pragma once
#include <placegraph/graph/image/decoded_pixels.h>
#include <placegraph/graph/image/image.h>

#include <string>
#include <string_view>

namespace placegraph {

/// Whether the bytes are a PNG or JPEG whose end is missing.
/// Decoders fill the missing pixels with grey or black and report success.
bool is_truncated_picture(std::string_view bytes);

/// Decodes a picture file; returns an empty image if the bytes are not a readable picture.
/// PNG and JPEG are read by the library, other formats by its module (picture_plugin.h). Throws
/// FileError, which names `wanted`, if the module is missing.
Image decode_picture(std::string_view bytes, DecodedPixels pixels, const std::string& wanted);

/// The bytes of a picture file in the format of the extension of `path` (upper or lower case).
/// Throws FileError for an unknown extension, and like decode_picture().
std::string encode_picture(const std::string& path, const Image& image);

}  // namespace placegraph
