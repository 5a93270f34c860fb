#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>

#include <string>

namespace placegraph {

/// The pixels of the images that a run does not use, in the images as they are given, before a lens
/// is corrected.
class RunMask {
 public:
  RunMask() = default;
  /// Reads a mask; an empty path masks nothing. Throws FileError for a file that is not an image,
  /// not of the camera's size, or that masks all pixels.
  RunMask(const std::string& path, const Camera& camera);

  void apply(Frame& frame) const;

 private:
  Image mask_;  // empty: all pixels are used
};

}  // namespace placegraph
