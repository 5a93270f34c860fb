#include <placegraph/io/files/output_file.h>
#include <placegraph/io/files/png_file.h>

namespace placegraph {

void write_png(const std::string& path, const Image& image, const PngCompression& compression) {
  write_file(path, encode_png(image, compression));
}

}  // namespace placegraph
