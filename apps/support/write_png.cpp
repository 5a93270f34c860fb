#include "apps/support/write_png.h"

#include "apps/support/output.h"

namespace placegraph::apps {

void write_png(const std::string& path, const Image& image, const PngCompression& compression) {
  write_file(path, encode_png(image, compression));
}

}  // namespace placegraph::apps
