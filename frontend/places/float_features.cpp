#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/float_features.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

cv::Mat resized(const Image& grey, int width) {
  require(!grey.empty() && grey.type() == CV_8UC1, "float_features: grey image needed");
  if (grey.cols == width) return grey;
  cv::Mat result;
  cv::resize(grey, result,
             {width, std::max(1, static_cast<int>(std::lround(static_cast<double>(grey.rows) *
                                                              width / grey.cols)))},
             0, 0, grey.cols > width ? cv::INTER_AREA : cv::INTER_CUBIC);
  return result;
}

FloatFeatures features_of(const cv::Mat& image, const std::vector<cv::KeyPoint>& keypoints,
                          const cv::Mat& sift) {
  FloatFeatures features;
  const auto width = static_cast<float>(image.cols);
  features.height = static_cast<float>(image.rows) / width;
  for (const cv::KeyPoint& keypoint : keypoints)
    features.position.emplace_back(keypoint.pt.x / width, keypoint.pt.y / width);
  features.descriptors.resize(sift.rows, kSiftNumbers);
  for (int i = 0; i < sift.rows; ++i) {
    auto row = features.descriptors.row(i);
    row = Eigen::Map<const Eigen::RowVectorXf>(sift.ptr<float>(i), kSiftNumbers);
    row = (row / std::max(row.sum(), 1e-6f)).cwiseSqrt().eval();
  }
  return features;
}

}  // namespace

FloatFeatures float_features(const Image& grey, const FloatFeatureOptions& options) {
  const cv::Mat image = resized(grey, options.width_px);
  // Those of SIFT (Lowe 2004): three layers an octave, edge ratio 10, blur 1.6.
  constexpr int kLayers = 3;
  constexpr double kEdge = 10, kSigma = 1.6;
  const auto sift =
      cv::SIFT::create(options.max_features, kLayers, options.contrast, kEdge, kSigma);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  sift->detectAndCompute(image, cv::noArray(), keypoints, descriptors);
  return features_of(image, keypoints, descriptors);
}

FloatFeatures dense_float_features(const Image& grey) {
  // Width and distance of dense features. Chosen.
  constexpr int kWidth = 160, kStep = 8;
  constexpr std::array<float, 2> kSizes = {4, 8};  // diameters; a patch is six of them wide
  const cv::Mat image = resized(grey, kWidth);
  std::vector<cv::KeyPoint> keypoints;
  for (const float size : kSizes)
    for (int y = kStep / 2; y < image.rows; y += kStep)
      for (int x = kStep / 2; x < image.cols; x += kStep)
        keypoints.emplace_back(static_cast<float>(x), static_cast<float>(y), size, 0.f);
  cv::Mat descriptors;
  cv::SIFT::create()->compute(image, keypoints, descriptors);
  return features_of(image, keypoints, descriptors);
}

}  // namespace placegraph
