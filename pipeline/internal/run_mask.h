#pragma once
#include <placegraph/pipeline/internal/lens_correction.h>
#include <placegraph/pipeline/slam.h>

#include <string>
#include <vector>

namespace placegraph {

/// The pixels of the images that a run does not use: those of a file, and static overlays that were
/// found. Pixels are those of the images as they are given, before a lens is corrected.
class RunMask {
 public:
  RunMask() = default;
  /// Reads a mask; an empty path masks nothing. Throws FileError for a file that is not an image,
  /// not of the camera's size, or that masks all pixels.
  RunMask(const std::string& path, const Camera& camera);

  void apply(Frame& frame) const;
  /// Adds a static overlay that `slam` has found in images corrected by `lens`, at most twice.
  /// Returns whether the run must restart.
  bool learn(const Slam& slam, const LensCorrection& lens);
  /// One note for each overlay that was added.
  const std::vector<DataNote>& notes() const { return notes_; }

 private:
  Image mask_;  // empty: all pixels are used
  std::vector<DataNote> notes_;
};

}  // namespace placegraph
