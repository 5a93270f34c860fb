#pragma once
#include <placegraph/graph/image/image.h>

#include <filesystem>
#include <string>

#include "tests/support/pictures.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::test {

/// A grey picture whose pixels tell where they are and which picture it is.
inline Image tiny_grey(int width, int height, int number) {
  Image image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>((7 * u + 3 * v + number) % 256);
    }
  }
  return image;
}

inline std::string write_image(const TemporaryFolder& folder, const std::string& relative,
                               const Image& image) {
  const std::string path = folder / relative;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  if (!test::write_picture(path, image)) throw std::runtime_error("cannot write " + path);
  return path;
}

/// `count` pictures 000000.png, ... in a folder.
inline void write_numbered(const TemporaryFolder& folder, const std::string& relative, int count,
                           int width = 8, int height = 6, int offset = 0) {
  for (int i = 0; i < count; ++i) {
    write_image(folder, relative + "/00000" + std::to_string(i) + ".png",
                tiny_grey(width, height, i + offset));
  }
}

/// A 16-bit picture filled with one value.
inline Image tiny_depth(int width, int height, std::uint16_t value) {
  return Image(height, width, CV_16UC1, cv::Scalar(value));
}

inline bool same_pixels(const Image& a, const Image& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace placegraph::test
