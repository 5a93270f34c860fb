#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace placegraph::apps {

/// Quality of the pictures that a browser gets: good enough to judge single pixels of tracks.
inline constexpr int kJpegQuality = 90;

/// The picture as an address: "data:image/jpeg;base64,...".
std::string jpeg_url(const Image& image);

}  // namespace placegraph::apps
