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

Image LensCorrection::mask_as_taken(const Image& mask) const {
  if (k1_ == 0) return mask;
  Camera camera = as_given_.camera;
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {k1_};
  Image taken(camera.height, camera.width, CV_8UC1, cv::Scalar(255));
  for (int v = 0; v < taken.rows; ++v)
    for (int u = 0; u < taken.cols; ++u) {
      const auto ray = camera.unproject({u, v});
      const auto px = ray ? undistorted_.camera.project(*ray) : std::nullopt;
      if (px && undistorted_.camera.contains(*px))
        taken.at<std::uint8_t>(v, u) = mask.at<std::uint8_t>(
            static_cast<int>(std::lround(px->y())), static_cast<int>(std::lround(px->x())));
    }
  return taken;
}

}  // namespace placegraph
