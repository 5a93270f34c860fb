#pragma once
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::test {

/// A picture of blurred colours, the same for the same number: a place as a camera sees it.
inline Image place_picture(int place) {
  Image coarse(9, 12, CV_8UC3), picture;
  cv::RNG random(static_cast<std::uint64_t>(place) + 1);
  random.fill(coarse, cv::RNG::UNIFORM, 20, 200);
  cv::resize(coarse, picture, {160, 120}, 0, 0, cv::INTER_CUBIC);
  return picture;
}

/// Of image 0 to 11 of the folder below.
inline std::string view_name(int image) {
  return "images/0000" + std::to_string(image + 10) + ".png";
}

/// Six places, each seen twice: images 0 to 5, and the same from beside as 6 to 11; gt.txt asks the
/// second half among the first.
inline void write_twelve_views(const TemporaryFolder& folder) {
  std::string truth;
  for (int i = 0; i < 12; ++i) {
    Image picture = place_picture(i % 6);
    if (i >= 6) picture = picture(cv::Rect(12, 0, 148, 120)).clone();
    cv::resize(picture, picture, {160, 120}, 0, 0, cv::INTER_AREA);
    write_image(folder, view_name(i), picture);
    if (i >= 6) truth += std::to_string(i) + " 0 5 " + std::to_string(i - 6) + "\n";
  }
  folder.write("gt.txt", truth);
}

}  // namespace placegraph::test
