#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Agreement of label images with the truth, pixel by pixel, over all images that were added.
class LabelCheck {
 public:
  explicit LabelCheck(int classes);

  /// `truth` and `labels` CV_8UC1 of one size; pixels whose truth is `classes` or more are void and
  /// not scored; a label that is no class is wrong everywhere. `confidence` CV_32FC1 or empty.
  /// Throws ArgumentError if sizes or types do not agree.
  void add(const Image& truth, const Image& labels, const Image& confidence = {});

  int classes() const { return classes_; }
  std::int64_t pixels() const;                     ///< number of scored pixels
  std::int64_t count(int truth, int label) const;  ///< label = classes: no class
  double pixel_accuracy() const;                   ///< share of the scored pixels that are right
  double class_accuracy() const;     ///< mean over the classes that occur of the share found
  double mean_iou() const;           ///< intersection over union, mean over classes that occur
  double accuracy(int label) const;  ///< share of a class's pixels that is found; NaN without any
  double iou(int label) const;       ///< NaN if the class neither occurs nor is predicted
  /// Expected calibration error: mean over 15 bins of confidence, by pixels, of |mean confidence -
  /// accuracy| (Guo et al. 2017); NaN without confidences.
  double calibration_error() const;

 private:
  // As Guo et al. 2017.
  static constexpr int kBins = 15;
  struct Bin {
    std::int64_t pixels = 0, right = 0;
    double confidence = 0;
  };
  int classes_;
  std::vector<std::int64_t> counts_;  ///< truth x (classes + 1)
  std::vector<Bin> bins_;
};

}  // namespace placegraph
