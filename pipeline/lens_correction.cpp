#include <fmt/format.h>
#include <placegraph/io/calibration/rectification.h>
#include <placegraph/pipeline/lens_correction.h>

#include <cmath>

namespace placegraph {

bool is_clear(const LensDistortion& lens, const LensOptions& options) {
  return options.enabled && lens.effect > options.min_effect &&
         std::abs(lens.k1) > options.min_sigmas * lens.sigma_k1;
}

bool is_distorted(const LensDistortion& lens, const LensOptions& options) {
  // At least two stretches of different view or motion agree (docs/datasets.md); one that overlaps
  // another counts for less.
  constexpr double kStretches = 1.8;
  return is_clear(lens, options) && lens.stretches >= kStretches;
}

std::optional<double> change_of_k1(double removed, const LensDistortion& seen, int pass,
                                   const LensOptions& options) {
  constexpr double kContradiction = 4, kChange = 1.5;  // standard deviations
  constexpr double kShare = 0.1, kUndone = 0.5;        // shares of the removed k1
  if (pass == 0) return is_distorted(seen, options) ? std::optional(seen.k1) : std::nullopt;
  if (pass > 1 || removed == 0 || !options.enabled) return std::nullopt;
  const double size = std::abs(removed), left = std::abs(seen.k1);
  if (std::abs(removed + seen.k1) < kUndone * size)
    return left > kContradiction * seen.sigma_k1 ? std::optional(-removed) : std::nullopt;
  const bool known = size > options.min_sigmas * seen.sigma_k1 && left > kChange * seen.sigma_k1;
  return known && left > kShare * size ? std::optional(seen.k1) : std::nullopt;
}

DataNote distortion_note(double removed, const LensDistortion& seen) {
  const std::string what =
      removed == 0 ? "none of it was removed" : fmt::format("{:.4f} of it was removed", removed);
  return {fmt::format("the images show radial distortion, k1 = {:.4f} +- {:.4f}; {}",
                      removed + seen.k1, seen.sigma_k1, what),
          false, NoteCause::kDistortion, "calibrate the lens, and run again"};
}

void LensCorrection::add(double k1) {
  k1_ += k1;
  Camera camera = as_given_.camera;
  camera.distortion = Distortion::kRadialTangential;
  camera.coefficients = {k1_};
  undistorted_ = std::make_shared<const UndistortedCamera>(undistort_camera(camera));
}

Calibration LensCorrection::calibration() const {
  Calibration calibration = as_given_;
  if (k1_ != 0) calibration.camera = undistorted_->camera;
  return calibration;
}

void LensCorrection::apply(Frame& frame) const {
  if (k1_ == 0) return;
  frame.image = undistorted_->remap.bilinear(frame.image);
  if (!frame.mask.empty()) frame.mask = undistorted_->remap.nearest(frame.mask);
}

Image LensCorrection::corrected(const Image& image) const {
  return k1_ == 0 ? image : undistorted_->remap.bilinear(image);
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
      const auto px = ray ? undistorted_->camera.project(*ray) : std::nullopt;
      if (px && undistorted_->camera.contains(*px))
        taken.at<std::uint8_t>(v, u) = mask.at<std::uint8_t>(
            static_cast<int>(std::lround(px->y())), static_cast<int>(std::lround(px->x())));
    }
  return taken;
}

}  // namespace placegraph
