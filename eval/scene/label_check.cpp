#include <placegraph/eval/scene/label_check.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

LabelCheck::LabelCheck(int classes)
    : classes_(classes),
      counts_(static_cast<std::size_t>(std::max(0, classes * (classes + 1))), 0),
      bins_(kBins) {
  require(classes > 0 && classes < 255, "LabelCheck: from 1 to 254 classes");
}

void LabelCheck::add(const Image& truth, const Image& labels, const Image& confidence) {
  require(truth.type() == CV_8UC1 && labels.type() == CV_8UC1 && truth.size() == labels.size(),
          "LabelCheck: two label images of one size are needed");
  require(
      confidence.empty() || (confidence.type() == CV_32FC1 && confidence.size() == truth.size()),
      "LabelCheck: confidences of another size or type");
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const int is = truth.at<std::uint8_t>(v, u);
      if (is >= classes_) continue;
      const int label = std::min<int>(labels.at<std::uint8_t>(v, u), classes_);
      ++counts_[static_cast<std::size_t>(is * (classes_ + 1) + label)];
      if (confidence.empty()) continue;
      const float sure = std::clamp(confidence.at<float>(v, u), 0.0f, 1.0f);
      Bin& bin =
          bins_[static_cast<std::size_t>(std::min(kBins - 1, static_cast<int>(sure * kBins)))];
      ++bin.pixels;
      bin.right += label == is ? 1 : 0;
      bin.confidence += static_cast<double>(sure);
    }
}

std::int64_t LabelCheck::count(int truth, int label) const {
  return counts_[static_cast<std::size_t>(truth * (classes_ + 1) + label)];
}

std::int64_t LabelCheck::pixels() const {
  std::int64_t sum = 0;
  for (const std::int64_t count : counts_) sum += count;
  return sum;
}

double LabelCheck::pixel_accuracy() const {
  std::int64_t right = 0;
  for (int c = 0; c < classes_; ++c) right += count(c, c);
  return pixels() > 0 ? static_cast<double>(right) / static_cast<double>(pixels()) : kNone;
}

double LabelCheck::accuracy(int label) const {
  std::int64_t all = 0;
  for (int c = 0; c <= classes_; ++c) all += count(label, c);
  return all > 0 ? static_cast<double>(count(label, label)) / static_cast<double>(all) : kNone;
}

double LabelCheck::iou(int label) const {
  std::int64_t any = -count(label, label);
  for (int c = 0; c <= classes_; ++c) any += count(label, c);
  for (int c = 0; c < classes_; ++c) any += count(c, label);
  return any > 0 ? static_cast<double>(count(label, label)) / static_cast<double>(any) : kNone;
}

double LabelCheck::class_accuracy() const {
  double sum = 0, present = 0;
  for (int c = 0; c < classes_; ++c)
    if (const double share = accuracy(c); !std::isnan(share)) sum += share, present += 1;
  return present > 0 ? sum / present : kNone;
}

double LabelCheck::mean_iou() const {
  double sum = 0, present = 0;
  for (int c = 0; c < classes_; ++c)
    if (!std::isnan(accuracy(c))) sum += iou(c), present += 1;
  return present > 0 ? sum / present : kNone;
}

double LabelCheck::calibration_error() const {
  double error = 0;
  std::int64_t all = 0;
  for (const Bin& bin : bins_) {
    error += std::abs(bin.confidence - static_cast<double>(bin.right));
    all += bin.pixels;
  }
  return all > 0 ? error / static_cast<double>(all) : kNone;
}

}  // namespace placegraph
