#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/image_levels.h>
#include <placegraph/io/files/image_file.h>

#include <algorithm>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

constexpr std::size_t kSampled = 8, kImagesASample = 20;
/// Dark if 99 % of the pixels are below it: corners are lost in the noise and the rounding.
constexpr int kDark = 32;
/// Least range of grey levels of 98 % of the pixels.
constexpr int kLittleContrast = 12;

/// The grey level [0, 255] with this share of the pixels below it.
int percentile(const std::vector<std::size_t>& histogram, double share) {
  std::size_t all = 0, below = 0;
  for (const std::size_t count : histogram) all += count;
  for (std::size_t level = 0; level < histogram.size(); ++level) {
    below += histogram[level];
    if (static_cast<double>(below) >= share * static_cast<double>(all))
      return static_cast<int>(level);
  }
  return 255;
}

int bits_of(double greatest) {
  int bits = 8;
  while (bits < 16 && greatest >= (1 << bits)) ++bits;
  return bits;
}

/// Adds the pixels after their conversion to 8 bits.
void add_pixels(const Image& stored, int bits, std::vector<std::size_t>& histogram) {
  Image grey = stored;
  if (stored.depth() == CV_16U) stored.convertTo(grey, CV_8U, 1.0 / (1 << (bits - 8)));
  grey = to_grey(grey);
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) ++histogram[grey.at<unsigned char>(y, x)];
}

/// Reads `count` images, evenly spaced, as they are stored; those of neither 8 nor 16 bits are
/// skipped.
std::vector<Image> some_images(const std::vector<std::string>& paths, std::size_t count) {
  std::vector<Image> images;
  for (std::size_t k = 0; k < count; ++k) {
    try {
      Image image = read_image_as_stored(paths[k * paths.size() / count]);
      if (image.channels() == 4) cv::extractChannel(image, image, 1);
      if (image.depth() == CV_8U || image.depth() == CV_16U) images.push_back(image);
    } catch (const Error&) {
    }
  }
  return images;
}

}  // namespace

ImageLevels sample_levels(const std::vector<std::string>& paths) {
  const std::size_t most = std::min(paths.size(), kSampled);
  std::vector<Image> images = some_images(paths, std::min<std::size_t>(most, 1));
  const bool first_of_16 = !images.empty() && images.front().depth() == CV_16U;
  const std::size_t count = first_of_16 ? most : std::min(most, paths.size() / kImagesASample);
  if (count > 1) images = some_images(paths, count);
  ImageLevels levels;
  if (images.empty()) return levels;
  double greatest_of_16 = 0;
  for (const Image& image : images) {
    if (image.depth() != CV_16U) continue;
    double greatest = 0;
    cv::minMaxLoc(image.reshape(1), nullptr, &greatest);
    greatest_of_16 = std::max(greatest_of_16, greatest);
    levels.of_16 = true;
  }
  if (levels.of_16) levels.bits = bits_of(greatest_of_16);
  if (levels.bits < 16)
    levels.notes.push_back(
        {fmt::format("the 16-bit images use only {} bits (up to {:.0f}): they are "
                     "scaled by that, uniformly for the sequence",
                     levels.bits, greatest_of_16)});
  std::vector<std::size_t> histogram(256, 0);
  for (const Image& image : images) add_pixels(image, levels.bits, histogram);
  const int low = percentile(histogram, 0.01), high = percentile(histogram, 0.99);
  if (high < kDark)
    levels.notes.push_back(
        {fmt::format("the images are very dark: 99 % of their pixels are at most {} of "
                     "255 grey levels",
                     high),
         false, NoteCause::kImages, ""});
  else if (high - low < kLittleContrast)
    levels.notes.push_back(
        {fmt::format("the images have hardly any contrast: 98 % of their pixels are "
                     "from {} to {} of 255 grey levels",
                     low, high),
         false, NoteCause::kImages, ""});
  return levels;
}

}  // namespace placegraph
