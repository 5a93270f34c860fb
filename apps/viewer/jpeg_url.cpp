#include "apps/viewer/jpeg_url.h"

#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/io/exports/base64.h>

namespace placegraph::apps {

std::string jpeg_url(const Image& image) {
  return "data:image/jpeg;base64," + to_base64(encode_jpeg(image, kJpegQuality));
}

}  // namespace placegraph::apps
