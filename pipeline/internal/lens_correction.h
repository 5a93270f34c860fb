#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/internal/calibration/rectification.h>
#include <placegraph/pipeline/run_options.h>
#include <placegraph/pipeline/slam.h>

namespace placegraph {

/// Whether images should be undistorted by `lens` before they are used.
bool is_distorted(const LensDistortion& lens, const LensOptions& options);

/// Takes radial distortion out of the images of one eye that should show none.
class LensCorrection {
 public:
  explicit LensCorrection(const Calibration& as_given) : as_given_(as_given) {}

  /// Adds to the distortion that is taken out: what was found in corrected images.
  void add(double k1);
  double k1() const { return k1_; }
  /// Of the corrected images.
  Calibration calibration() const;
  void apply(Frame& frame) const;

 private:
  Calibration as_given_;
  double k1_ = 0;
  UndistortedCamera undistorted_;
};

}  // namespace placegraph
