#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr std::uintmax_t kMaxImageBytes = std::uintmax_t{1} << 30;
constexpr int kLeastSide = 4;  ///< smallest side of an image [px]: less is only a line

std::string read_bytes(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw FileError(path, "image is missing");
  require_input_file(path);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) throw FileError(path, "image cannot be read");
  if (size == 0) throw FileError(path, "image file is empty");
  if (size > kMaxImageBytes) throw FileError(path, "image file is larger than 1 GiB");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) {
    throw FileError(path, "image cannot be read");
  }
  return bytes;
}

cv::Mat decode(const std::string& path, DecodedPixels pixels) {
  const std::string bytes = read_bytes(path);
  if (is_truncated_picture(bytes)) throw FileError(path, "image is truncated");
  cv::Mat image = decode_picture(bytes, pixels, path);
  if (image.empty()) throw FileError(path, "is no readable image");
  return image;
}

}  // namespace

GreyAndColour read_image(const std::string& path, int bits) {
  GreyAndColour result;
  cv::Mat image =
      decode(path, bits < 16 ? DecodedPixels::kGreyOrColour : DecodedPixels::kEightBits);
  if (image.depth() == CV_16U) {
    // Rounded down, as the lower bits are dropped: half a step keeps convertTo from rounding up.
    const double scale = 1.0 / (1 << (bits - 8));
    image.convertTo(image, CV_8U, scale, 0.5 * scale - 0.5);
  }
  if (std::min(image.cols, image.rows) < kLeastSide)
    throw FileError(path, fmt::format("image is {}x{}: no picture is under {} px high or wide",
                                      image.cols, image.rows, kLeastSide));
  if (image.channels() == 3) result.colour = image;
  result.grey = to_grey(image);
  return result;
}

Image read_image_as_stored(const std::string& path) {
  return decode(path, DecodedPixels::kAsStored);
}

Image read_depth(const std::string& path, double unit_m) {
  const cv::Mat raw = read_image_as_stored(path);
  if (raw.type() != CV_16UC1) {
    throw FileError(path, "depth image must have one channel of 16 bits");
  }
  cv::Mat exact, depth;
  raw.convertTo(exact, CV_64F, unit_m);  // 3000 mm are 3 m, not the 3.0000002 of float factors
  exact.convertTo(depth, CV_32F);
  depth.setTo(0, raw == 65535);
  return depth;
}

void write_image(const std::string& path, const Image& image) {
  const std::string bytes = encode_picture(path, image);
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

Image to_grey(const Image& image) {
  if (image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

void require_size(const std::string& path, const Image& image, int width, int height) {
  if (image.cols == width && image.rows == height) return;
  throw FileError(path, fmt::format("image is {}x{}, but {}x{} is expected", image.cols, image.rows,
                                    width, height));
}

}  // namespace placegraph
