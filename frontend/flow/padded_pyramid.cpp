#include <placegraph/frontend/flow/padded_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace placegraph {

PaddedPyramid padded_pyramid(const Image& grey, int levels, int pad) {
  require(grey.type() == CV_8UC1 && !grey.empty(), "padded_pyramid: a grey image is needed");
  require(std::min(grey.cols, grey.rows) > pad, "padded_pyramid: the image is too small");
  PaddedPyramid pyramid;
  pyramid.pad = pad;
  pyramid.width = grey.cols;
  pyramid.height = grey.rows;
  Image image;
  grey.convertTo(image, CV_32F);
  const int least = std::max(pad + 1, 8);
  for (int level = 0; level < levels; ++level) {
    if (level > 0) {
      if ((std::min(image.cols, image.rows) + 1) / 2 < least) break;
      Image half;
      cv::pyrDown(image, half);
      image = half;
    }
    Image padded;
    cv::copyMakeBorder(image, padded, pad, pad, pad, pad, cv::BORDER_REFLECT_101);
    pyramid.levels.push_back(padded);
  }
  return pyramid;
}

}  // namespace placegraph
