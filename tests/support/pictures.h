#pragma once
#include <placegraph/graph/image/picture.h>

#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <string>

namespace placegraph::test {

/// The picture of a file; empty if there is none.
inline Image read_picture(const std::string& path,
                          DecodedPixels pixels = DecodedPixels::kEightBits) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return bytes.empty() ? Image() : decode_picture(bytes, pixels, path);
}

/// The picture of a file in grey (CV_8UC1); empty if there is none.
inline Image read_grey_picture(const std::string& path) {
  Image image = read_picture(path);
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  return image;
}

/// Writes the image in the format of the extension; false if the file cannot be written.
inline bool write_picture(const std::string& path, const Image& image) {
  std::ofstream stream(path, std::ios::binary);
  stream << encode_picture(path, image);
  return stream.flush().good();
}

}  // namespace placegraph::test
