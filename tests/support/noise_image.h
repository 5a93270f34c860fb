#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/image/image.h>

#include <opencv2/imgproc.hpp>

namespace placegraph::test {

/// Noise of 8 bits (CV_8UC1 or CV_8UC3), made smooth over `blur_px`.
inline Image noise_image(int width, int height, int type, double blur_px, std::uint64_t seed) {
  Random random(seed);
  Image image(height, width, type);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width * image.channels(); ++x)
      image.ptr<uchar>(y)[x] = static_cast<uchar>(random.index(256));
  if (blur_px > 0) cv::GaussianBlur(image, image, {}, blur_px);
  return image;
}

}  // namespace placegraph::test
