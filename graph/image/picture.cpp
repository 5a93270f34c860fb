#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/picture.h>
#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/graph/image/png_codec.h>

#include <algorithm>
#include <filesystem>

namespace placegraph {

bool is_truncated_picture(std::string_view bytes) {
  if (is_png(bytes)) return is_truncated_png(bytes);
  return is_jpeg(bytes) && is_truncated_jpeg(bytes);
}

Image decode_picture(std::string_view bytes, DecodedPixels pixels, const std::string& wanted) {
  if (is_png(bytes)) return decode_png(bytes, pixels);
  if (is_jpeg(bytes)) return decode_jpeg(bytes);
  return picture_plugin(wanted).decode(bytes, pixels);
}

std::string encode_picture(const std::string& path, const Image& image) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (extension == ".png") return encode_png(image);
  std::string bytes = picture_plugin(path).encode(extension, image, {});
  if (bytes.empty()) throw FileError(path, "cannot be written as a picture: unknown extension");
  return bytes;
}

}  // namespace placegraph
