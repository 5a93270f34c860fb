#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/local_map/lens_distortion.h>
#include <placegraph/pipeline/run_options.h>

#include <memory>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

struct UndistortedCamera;

/// Whether `lens` is clear: beyond its standard deviation and by its effect.
bool is_clear(const LensDistortion& lens, const LensOptions& options);
/// Whether images should be undistorted with `lens` before they are used.
/// It is clear, and more than one stretch of motion shows it.
bool is_distorted(const LensDistortion& lens, const LensOptions& options);

/// Change of the removed k1 with which a run should begin again, if it should.
///
/// `removed` was removed in this pass, which is the one of number `pass` (0: the first, which
/// removes nothing), and `seen` is left. The first estimate may be too small, because tracks that
/// contradict undistorted images were dropped: it is refined once. It is undone if the corrected
/// images show by four standard deviations that less than half of it was there: it was then wrong
/// rather than inaccurate.
std::optional<double> change_of_k1(double removed, const LensDistortion& seen, int pass,
                                   const LensOptions& options);
/// What a run reports of the distortion `seen` that it leaves in its images.
/// `removed` is what it took out of them.
DataNote distortion_note(double removed, const LensDistortion& seen);

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
  /// A corrected image, of any type.
  Image corrected(const Image& image) const;
  /// Mask of the given images (CV_8UC1) with the pixels that `mask` marks in corrected ones.
  Image mask_as_taken(const Image& mask) const;

 private:
  Calibration as_given_;
  double k1_ = 0;
  std::shared_ptr<const UndistortedCamera> undistorted_;  // null: nothing was removed yet
};

}  // namespace placegraph
