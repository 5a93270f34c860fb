#include <placegraph/frontend/labels/label_field.h>
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

// Size to which images are reduced. Chosen.
constexpr double kWorkPixels = 480 * 360;
constexpr int kLeastSide = 32;

void to_bytes(const float* shares, std::size_t n, std::uint8_t* bytes) {
  for (std::size_t c = 0; c < n; ++c) bytes[c] = static_cast<std::uint8_t>(shares[c] * 255 + 0.5f);
}

/// Writes the features of a superpixel, then those of its context.
void second_row(const ByteFeatures& features, const ByteFeatures& context, int i,
                std::vector<std::uint8_t>& row) {
  std::copy_n(features.row(i), features.dimension, row.begin());
  std::copy_n(context.row(i), context.dimension, row.begin() + features.dimension);
}

}  // namespace

Image scene_picture(const Image& picture) {
  require(!picture.empty() && (picture.type() == CV_8UC3 || picture.type() == CV_8UC1),
          "view_scene: needs an image of 8 bits, BGR or grey");
  require(std::min(picture.rows, picture.cols) >= kLeastSide,
          "view_scene: the image is smaller than " + std::to_string(kLeastSide) + " pixels");
  Image bgr = picture;
  if (picture.channels() == 1) cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  const double scale = std::sqrt(kWorkPixels / (static_cast<double>(bgr.rows) * bgr.cols));
  const auto even = [&](int side) {
    return std::max(kLeastSide, 2 * static_cast<int>(std::lround(side * scale / 2)));
  };
  const cv::Size size(even(bgr.cols), even(bgr.rows));
  if (size == bgr.size()) return bgr;
  Image resized;
  cv::resize(bgr, resized, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

SceneView view_scene(const Image& picture) {
  const Image bgr = scene_picture(picture);
  SceneView view;
  view.rows = picture.rows;
  view.cols = picture.cols;
  view.superpixels = cut_superpixels(bgr);
  view.features = superpixel_features(bgr, view.superpixels);
  return view;
}

void sharpen(std::vector<float>& shares, int n, float power) {
  for (std::size_t at = 0; at < shares.size(); at += static_cast<std::size_t>(n)) {
    float sum = 0;
    for (std::size_t c = at; c < at + static_cast<std::size_t>(n); ++c)
      sum += shares[c] = std::pow(std::max(shares[c], 1e-6f), power);
    for (std::size_t c = at; c < at + static_cast<std::size_t>(n); ++c) shares[c] /= sum;
  }
}

std::vector<float> classify_superpixels(const SceneModel& model, const SceneView& view,
                                        const LabellerOptions& options) {
  options.check();
  const int classes = model.class_count();
  const auto n = static_cast<std::size_t>(classes);
  require(model.first.dimension == view.features.dimension &&
              model.second.dimension == view.features.dimension + context_dimension(classes),
          "classify_superpixels: the model has other features");
  const int count = view.superpixels.count;
  std::vector<float> shares(static_cast<std::size_t>(count) * n);
  for (int i = 0; i < count; ++i)
    model.first.predict(view.features.row(i), shares.data() + static_cast<std::size_t>(i) * n);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(model.second.dimension));
  for (int round = 0; options.context && round < options.rounds; ++round) {
    ByteFeatures bytes{count, classes, std::vector<std::uint8_t>(shares.size())};
    for (int i = 0; i < count; ++i)
      to_bytes(shares.data() + static_cast<std::size_t>(i) * n, n, bytes.row(i));
    const ByteFeatures context = context_features(bytes, view.superpixels);
    for (int i = 0; i < count; ++i) {
      second_row(view.features, context, i, row);
      model.second.predict(row.data(), shares.data() + static_cast<std::size_t>(i) * n);
    }
  }
  LabelField field{classes, 0, 0, model.relations};
  if (options.field) field.smoothness = static_cast<double>(model.smoothness);
  if (options.field && options.relations)
    field.relation_weight = static_cast<double>(model.relation_weight);
  std::vector<float> marginals = field_marginals(field, shares, view.superpixels, view.features);
  sharpen(marginals, classes, model.sharpness);
  return marginals;
}

SceneLabels most_probable(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double unknown_below) {
  const Superpixels& superpixels = view.superpixels;
  const auto n = static_cast<std::size_t>(classes);
  require(probabilities.size() == static_cast<std::size_t>(superpixels.count) * n &&
              !superpixels.index.empty(),
          "most_probable: the sizes do not agree");
  SceneLabels result;
  result.labels = Image(superpixels.rows, superpixels.cols, CV_8UC1);
  result.confidence = Image(superpixels.rows, superpixels.cols, CV_32FC1);
  for (int v = 0; v < superpixels.rows; ++v)
    for (int u = 0; u < superpixels.cols; ++u) {
      const float* p =
          probabilities.data() + static_cast<std::size_t>(superpixels.index.at<int>(v, u)) * n;
      const auto best = std::max_element(p, p + n);
      result.confidence.at<float>(v, u) = *best;
      result.labels.at<std::uint8_t>(v, u) = static_cast<double>(*best) < unknown_below
                                                 ? static_cast<std::uint8_t>(classes)
                                                 : static_cast<std::uint8_t>(best - p);
    }
  const cv::Size size(view.cols, view.rows);
  if (result.labels.size() != size) {
    cv::resize(result.labels, result.labels, size, 0, 0, cv::INTER_NEAREST);
    cv::resize(result.confidence, result.confidence, size, 0, 0, cv::INTER_NEAREST);
  }
  return result;
}

}  // namespace placegraph
