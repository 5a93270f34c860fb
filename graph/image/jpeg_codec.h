#pragma once
#include <placegraph/graph/image/image.h>

#include <string>
#include <string_view>

namespace placegraph {

/// Whether the bytes begin as a JPEG does.
bool is_jpeg(std::string_view bytes);

/// Whether the end mark of a JPEG is missing. The end mark of a thumbnail in the header does not
/// count.
bool is_truncated_jpeg(std::string_view bytes);

/// Decodes a JPEG, baseline or progressive, to CV_8UC1 if it is grey and else to CV_8UC3 BGR;
/// returns an empty image if the bytes are not a JPEG, or if pixels are missing or damaged as far
/// as the code shows it. Bytes behind the end mark, and a few before one, do no harm. Inks (CMYK)
/// are converted to colours. The pixels are those of OpenCV's imdecode; the EXIF orientation is not
/// applied.
Image decode_jpeg(std::string_view bytes);

/// The bytes of a JPEG file, baseline, of a CV_8UC1 or CV_8UC3 BGR image; `quality` from 1 to 100.
/// Throws ArgumentError for another type or an empty image.
std::string encode_jpeg(const Image& image, int quality);

}  // namespace placegraph
