#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Finds dark spots that are fixed to the camera: drops and dust on the lens, which blur and let
/// the world through, so that no patch of theirs stands still.
///
/// A spot is darker than the image on seven of eight sides, in most images of a camera in motion,
/// while the image beside it changes.
class LensSpots {
 public:
  /// Adds an image (CV_8UC1) of a camera in motion; all have one size.
  void add(const Image& image);
  /// Number of images so far.
  int images() const { return images_; }
  /// The spots (CV_8UC1, 255; 0 elsewhere), in the size of the images; empty if there are too few
  /// of them, or too few images.
  Image region() const;
  void visit_state(auto& archive) { archive(width_, height_, images_, sum_, squares_, darker_); }

 private:
  std::int32_t width_ = 0, height_ = 0, images_ = 0;
  // Of the logarithms of the reduced images, row by row.
  std::vector<float> sum_, squares_;
  std::vector<std::int32_t> darker_;  // images in which a pixel is darker, radius after radius
};

}  // namespace placegraph
