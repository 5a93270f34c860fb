#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/internal/image/decoded_pixels.h>

#include <string>
#include <string_view>

namespace placegraph {

/// Whether the bytes are the begin of a PNG or JPEG whose end is missing.
/// Decoders fill what is missing with grey or black and call that success.
bool is_truncated_picture(std::string_view bytes);

/// Decodes a picture file; gives an empty image if the bytes are no picture that can be read.
/// PNG and JPEG are read by the library, other formats by its module (picture_plugin.h): throws
/// FileError, which names `wanted`, where that is not there.
Image decode_picture(std::string_view bytes, DecodedPixels pixels, const std::string& wanted);

/// The bytes of a picture file in the format of the extension of `path`, whatever its case.
/// Throws FileError for an extension that no format has, and like decode_picture().
std::string encode_picture(const std::string& path, const Image& image);

}  // namespace placegraph
