#pragma once
#include <placegraph/graph/core/random.h>

#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::test {

/// What a camera sees that passes the long wall of a room, `x_px` along it, with noise: blurred
/// colours, others in every room.
inline Image wall_view(int room, int x_px, Random& random) {
  Image coarse(12, 36, CV_8UC3), wall;
  cv::RNG colours(static_cast<std::uint64_t>(room) + 1);
  colours.fill(coarse, cv::RNG::UNIFORM, 20, 220);
  cv::resize(coarse, wall, {480, 160}, 0, 0, cv::INTER_CUBIC);
  Image view = wall(cv::Rect(x_px, 20, 160, 120)).clone();
  for (int v = 0; v < view.rows; ++v)
    for (int u = 0; u < view.cols; ++u)
      for (int c = 0; c < 3; ++c) {
        auto& value = view.at<cv::Vec3b>(v, u)[c];
        value = cv::saturate_cast<std::uint8_t>(value + random.normal(0, 3));
      }
  return view;
}

/// A walk through rooms 0, 1, ... of `views` images each, numbered through, from `x_px` on along
/// each wall in steps of 4 px.
inline void write_walk(const TemporaryFolder& folder, const std::string& relative, int rooms,
                       int views, int x_px = 0, std::uint64_t seed = 1) {
  Random random(seed);
  for (int i = 0; i < rooms * views; ++i) {
    char name[16];
    std::snprintf(name, sizeof name, "/%06d.png", i);
    write_image(folder, relative + name, wall_view(i / views, x_px + 4 * (i % views), random));
  }
}

}  // namespace placegraph::test
