#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/thumbnail.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace placegraph {

std::string thumbnail_of(const Image& image) {
  constexpr int kLongest = 160, kQuality = 80;
  const double scale = static_cast<double>(kLongest) / std::max(image.cols, image.rows);
  if (!(scale < 1)) return encode_jpeg(image, kQuality);
  Image small;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  return encode_jpeg(small, kQuality);
}

}  // namespace placegraph
