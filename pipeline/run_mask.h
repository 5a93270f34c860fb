#pragma once
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/lens_correction.h>
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

  /// Adds the overlays that an interrupted run has found. Throws ArgumentError unless they are of
  /// the camera's size.
  void take_up(const std::vector<MaskedOverlay>& overlays, const Camera& camera);

  void apply(Frame& frame) const;
  /// Adds a static overlay that `slam` has found in images corrected by `lens`, at most twice.
  /// Returns whether the run must restart.
  bool learn(const Slam& slam, const LensCorrection& lens);
  /// The overlays that were added.
  const std::vector<MaskedOverlay>& overlays() const { return overlays_; }

 private:
  Image mask_;  // empty: all pixels are used
  std::vector<MaskedOverlay> overlays_;
};

}  // namespace placegraph
