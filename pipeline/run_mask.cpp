#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/pipeline/overlays/static_overlay.h>
#include <placegraph/pipeline/run_mask.h>

#include <opencv2/core.hpp>

namespace placegraph {

RunMask::RunMask(const std::string& path, const Camera& camera) {
  if (path.empty()) return;
  mask_ = read_image(path).grey;
  require_size(path, mask_, camera.width, camera.height);
  if (cv::countNonZero(mask_) == 0)
    throw FileError(path, "masks the whole image: all pixels are 0");
}

void RunMask::apply(Frame& frame) const { frame.mask = both_masks(frame.mask, mask_); }

void RunMask::take_up(const std::vector<MaskedOverlay>& overlays, const Camera& camera) {
  for (const MaskedOverlay& overlay : overlays) {
    require(overlay.mask.cols == camera.width && overlay.mask.rows == camera.height,
            "the mask of an overlay has another size than the images");
    mask_ = both_masks(mask_, overlay.mask);
  }
  overlays_ = overlays;
}

bool RunMask::learn(const Slam& slam, const LensCorrection& lens) {
  // Restarts of a run for what moves with the camera: the cost. Chosen.
  constexpr std::size_t kMost = 2;
  if (overlays_.size() >= kMost) return false;
  const Image found = slam.overlay_mask();
  if (found.empty()) return false;
  MaskedOverlay overlay{lens.mask_as_taken(found), {}};
  for (const DataNote& note : slam.notes())
    if (note.cause == NoteCause::kStaticOverlay) overlay.note = note;
  mask_ = both_masks(mask_, overlay.mask);
  overlays_.push_back(std::move(overlay));
  return true;
}

}  // namespace placegraph
