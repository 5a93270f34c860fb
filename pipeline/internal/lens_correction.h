#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/internal/calibration/rectification.h>
#include <placegraph/pipeline/run_options.h>
#include <placegraph/pipeline/slam.h>

namespace placegraph {

/// Whether images should be undistorted with `lens` before they are used.
bool is_distorted(const LensDistortion& lens, const LensOptions& options);

/// Removes radial distortion from monocular images that are expected to be undistorted.
class LensCorrection {
 public:
  explicit LensCorrection(const Calibration& as_given) : as_given_(as_given) {}

  /// Adds `k1`, which was estimated from corrected images, to the removed distortion.
  void add(double k1);
  /// Removes nothing again.
  void reset() { *this = LensCorrection(as_given_); }
  double k1() const { return k1_; }
  /// Calibration of the corrected images.
  Calibration calibration() const;
  void apply(Frame& frame) const;
  /// Mask of the given images (CV_8UC1) with the pixels that `mask` marks in corrected ones.
  Image mask_as_taken(const Image& mask) const;

 private:
  Calibration as_given_;
  double k1_ = 0;
  UndistortedCamera undistorted_;
};

}  // namespace placegraph
