#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>

#include <memory>

namespace [[gnu::visibility("default")]] placegraph {

struct Remap;

/// Converts the images of one camera into those of another.
/// The other one is at the same position and in the same direction. Neither has distortion.
/// Immutable: may be used from several threads.
class CameraChange {
 public:
  /// Throws ArgumentError for invalid or distorted cameras.
  CameraChange(const Camera& from, const Camera& to);

  /// Whether the two cameras agree to a millionth: frames are then left unchanged.
  bool is_identity() const { return remap_ == nullptr; }
  /// Share of the other camera's image that this one covers, 0 to 1.
  double seen_share() const { return seen_share_; }
  /// Converts image, colour and mask; pixels outside the first camera's view are masked (and
  /// continue the border's pixels). Depth and the right camera's image are dropped, because they
  /// belong to the camera that took them.
  void apply(Frame& frame) const;

 private:
  std::shared_ptr<const Remap> remap_;  // null: the two cameras agree
  Image seen_;  ///< CV_8UC1, 0 where `from` has no view or a descriptor's patch is partly outside
  double seen_share_ = 1;
  double blur_sigma_px_ = 0;  ///< blur of the input image before downscaling
};

}  // namespace placegraph
