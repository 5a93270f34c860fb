#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/image/image.h>

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace placegraph::test {

/// A drawn street: bright sky above (0), grey road below (1), a textured wall between (2) and a red
/// box on the road (3); its pixels' classes in `labels`.
struct DrawnStreet {
  Image bgr, labels;
};

inline DrawnStreet draw_street(std::uint64_t seed, cv::Size size = {240, 180}) {
  Random random(seed);
  DrawnStreet street{Image(size, CV_8UC3), Image(size, CV_8UC1)};
  const int horizon = size.height / 2 + random.index(size.height / 10);
  const int roof = size.height / 5 + random.index(size.height / 10);
  const int wall = size.width / 6 + random.index(size.width / 3);
  const cv::Rect box(size.width / 4 + random.index(size.width / 3), horizon - 5, size.width / 5,
                     size.height / 5);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      const bool built = u < wall || u > size.width - wall / 2;
      int label = v >= horizon ? 1 : built && v > roof ? 2 : 0;
      if (box.contains({u, v})) label = 3;
      const int noise = random.index(10);
      const bool stripe = (u / 6 + v / 4) % 2 == 0;
      const std::array<cv::Vec3b, 4> colours = {
          cv::Vec3b(230, 210, 200),
          {90, 90, 92},
          stripe ? cv::Vec3b(40, 60, 100) : cv::Vec3b(90, 120, 160),
          {30, 30, 200}};
      street.labels.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(label);
      for (int c = 0; c < 3; ++c)
        street.bgr.at<cv::Vec3b>(v, u)[c] =
            static_cast<std::uint8_t>(colours[static_cast<std::size_t>(label)][c] + noise);
    }
  return street;
}

}  // namespace placegraph::test
