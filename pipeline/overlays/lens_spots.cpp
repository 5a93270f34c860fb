#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/overlays/lens_spots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Columns of the reduced images, and radii of spots in their pixels: 2 to 5 % of the width.
constexpr int kColumns = 155;
constexpr std::array kRadii = {3, 4, 6, 8};
/// Distance from a spot's centre to the image beside it, in radii: beyond its blurred edge.
constexpr double kBeside = 1.7;
// The following are chosen between recordings and rendered drives with 40 blurred spots on the lens,
// which have 14 to 29 by these numbers, and the same ones without, which have none (one: 3).
/// Darkness of a spot: logarithm of grey values, in a single image and in their mean.
constexpr float kDarker = 0.1F, kMeanDarker = 0.25F;
/// Share of the images in which it is darker.
constexpr double kMostImages = 0.8;
/// Standard deviation over time of the logarithms beside a spot, above which the world moves there.
constexpr float kChange = 0.15F;
/// Fewest spots and images.
constexpr int kFewestSpots = 6, kFewestImages = 30;

cv::Mat1f mean_of_disc(const cv::Mat1f& image, int radius) {
  cv::Mat1f mean;
  const int side = std::max(1, radius / 2 * 2 - 1);
  cv::blur(image, mean, {side, side});
  return mean;
}

int distance_beside(int radius) { return static_cast<int>(std::lround(kBeside * radius)); }

/// By how much pixels are darker than the second darkest of eight sides; a side beyond the border is
/// the darkest.
cv::Mat1f darkness(const cv::Mat1f& image, int radius) {
  constexpr float kBeyond = -1e3F;
  const cv::Mat1f mean = mean_of_disc(image, radius);
  const int d = distance_beside(radius);
  cv::Mat1f padded;
  cv::copyMakeBorder(mean, padded, d, d, d, d, cv::BORDER_CONSTANT, cv::Scalar(kBeyond));
  cv::Mat1f darkest(mean.size(), -kBeyond), second(mean.size(), -kBeyond);
  for (int side = 0; side < 8; ++side) {
    const double angle = side * std::numbers::pi / 4;
    const auto du = static_cast<int>(std::lround(d * std::cos(angle)));
    const auto dv = static_cast<int>(std::lround(d * std::sin(angle)));
    const cv::Mat1f beside = padded(cv::Rect(d + du, d + dv, mean.cols, mean.rows));
    second = cv::min(second, cv::max(darkest, beside));
    darkest = cv::min(darkest, beside);
  }
  return second - mean;
}

cv::Mat1f logarithms(const Image& image) {
  const int reduction = std::max(1, image.cols / kColumns);
  cv::Mat small;
  cv::resize(image, small, {image.cols / reduction, image.rows / reduction}, 0, 0, cv::INTER_AREA);
  // Black has a logarithm, too: as much is added as noise and black level are. Chosen.
  constexpr double kBlack_grey = 4;
  cv::Mat1f result;
  small.convertTo(result, CV_32F, 1, kBlack_grey);
  cv::log(result, result);
  return result;
}

}  // namespace

void LensSpots::add(const Image& image) {
  const cv::Mat1f logs = logarithms(image);
  const auto pixels = static_cast<std::size_t>(logs.total());
  if (images_++ == 0) {
    width_ = image.cols, height_ = image.rows;
    sum_.assign(pixels, 0), squares_.assign(pixels, 0);
    darker_.assign(pixels * kRadii.size(), 0);
  }
  require(width_ == image.cols && height_ == image.rows && sum_.size() == pixels &&
              squares_.size() == pixels && darker_.size() == pixels * kRadii.size(),
          "the spots on the lens are those of another camera");
  std::size_t i = 0;
  for (const float value : logs) sum_[i] += value, squares_[i++] += value * value;
  i = 0;
  for (const int radius : kRadii)
    for (const float value : darkness(logs, radius)) darker_[i++] += value > kDarker;
}

Image LensSpots::region() const {
  if (images_ < kFewestImages) return {};
  const int reduction = std::max(1, width_ / kColumns);
  const cv::Size size(width_ / reduction, height_ / reduction);
  cv::Mat1f mean(size), deviation(size);
  std::size_t i = 0;
  for (float& value : mean) value = sum_[i++] / static_cast<float>(images_);
  i = 0;
  for (float& value : deviation) {
    const float of_mean = sum_[i] / static_cast<float>(images_);
    value = std::sqrt(std::max(0.F, squares_[i++] / static_cast<float>(images_) - of_mean * of_mean));
  }
  Image spots = Image::zeros(size, CV_8UC1), grown = spots.clone(), labels;
  i = 0;
  for (const int radius : kRadii) {
    const int d = distance_beside(radius);
    cv::Mat1f change;
    cv::blur(deviation, change, {2 * d + 1, 2 * d + 1});
    Image dark = (darkness(mean, radius) > kMeanDarker) & (change > kChange);
    for (cv::Mat1b::iterator at = dark.begin<std::uint8_t>(); at != dark.end<std::uint8_t>(); ++at)
      if (darker_[i++] < kMostImages * images_) *at = 0;
    spots |= dark;
    const int reach = radius / 2;  // the pixels found are those around the centre
    cv::dilate(dark, dark,
               cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
    grown |= dark;
  }
  if (cv::connectedComponents(spots, labels) - 1 < kFewestSpots) return {};
  cv::resize(grown, grown, {width_, height_}, 0, 0, cv::INTER_NEAREST);
  return grown;
}

}  // namespace placegraph
