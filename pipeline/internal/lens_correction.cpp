#include <placegraph/pipeline/internal/lens_correction.h>

#include <cmath>

namespace placegraph {

bool is_distorted(const LensDistortion& lens, const LensOptions& options) {
  return options.enabled && lens.effect > options.min_effect &&
         std::abs(lens.k1) > options.min_sigmas * lens.sigma_k1;
}

void LensCorrection::add(double k1) {
  k1_ += k1;
  Camera camera = as_given_.camera;
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {k1_};
  undistorted_ = undistort_camera(camera);
}

Calibration LensCorrection::calibration() const {
  Calibration calibration = as_given_;
  if (k1_ != 0) calibration.camera = undistorted_.camera;
  return calibration;
}

void LensCorrection::apply(Frame& frame) const {
  if (k1_ == 0) return;
  frame.image = undistorted_.remap.bilinear(frame.image);
  if (!frame.mask.empty()) frame.mask = undistorted_.remap.nearest(frame.mask);
}

}  // namespace placegraph
