#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/internal/calibration/rectification.h>

namespace placegraph {

/// Turns the images of one camera into those that another would have taken from the same place and
/// in the same direction. Both are without distortion. Immutable: may be used from several threads.
class CameraChange {
 public:
  /// Throws ArgumentError for invalid or distorted cameras.
  CameraChange(const Camera& from, const Camera& to);

  /// Whether the two are the same to a millionth: frames are left as they are.
  bool is_identity() const { return remap_.is_identity(); }
  /// Share of the other camera's image that this one sees, 0 to 1.
  double seen_share() const { return seen_share_; }
  /// Image, colour and mask; what is not seen is masked (and goes on as the border's pixels). Depth
  /// and the right eye's image belong to the camera that took them: they are dropped.
  void apply(Frame& frame) const;

 private:
  Remap remap_;
  Image seen_;  ///< CV_8UC1, 0 where `from` does not see or what is described lies partly there
  double seen_share_ = 1;
  double blur_sigma_px_ = 0;  ///< before images are made smaller, of the image that is given
};

}  // namespace placegraph
