#pragma once
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/overlays/lens_spots.h>
#include <placegraph/pipeline/overlays/standing_patches.h>
#include <placegraph/pipeline/overlays/static_overlay_options.h>

#include <map>
#include <optional>
#include <string>

namespace placegraph {

/// Finds and masks static overlays: regions fixed to the camera, such as dirt on the lens, a time
/// stamp or the bonnet. A region that is masked once remains masked.
///
/// Patches that stand still are watched at next to no cost (StandingPatches). Only when some of
/// them have stood still for long while others moved, points elsewhere are tracked until most have
/// moved: their motion says by how much every point of the world must have moved (ImageMotion).
/// Spots through which the world is seen are found by their darkness (LensSpots).
class StaticOverlay {
 public:
  /// `camera`: that of the (left) images.
  StaticOverlay(const StaticOverlayOptions& options, const Camera& camera, std::uint64_t seed);

  /// Adds a frame before it is processed; returns whether the mask has grown.
  bool add(const Frame& frame);
  /// The frame with its mask extended by that of the overlay.
  Frame apply(const Frame& frame) const;
  /// CV_8UC1, 0 in regions fixed to the camera; empty: nothing was found.
  const Image& mask() const { return mask_; }
  /// Whether most landmarks of a view lie in the masked region.
  bool has_captured(const FrameView& view) const;
  /// What is masked, as one line without a full stop.
  std::string text() const;
  std::optional<DataNote> note() const;
  /// Number of images in which points were tracked.
  int tracked_images() const { return tracked_images_; }
  /// An episode in progress is not part of the state: another one begins.
  void visit_state(auto& archive) {
    archive(patches_, mask_, frames_, last_cells_, without_result_, next_, tracked_images_, spots_,
            next_spots_);
  }

 private:
  void track(const Frame& frame);
  bool go_on(const Frame& frame, const Image& used);
  void begin(const Image& mask);
  bool judge(FrameId frame);
  bool take_region();
  bool watch_spots(const Image& image, const Image& used);
  bool cover(const Image& region);
  Image reduced(const Image& image, int interpolation) const;
  Eigen::Vector2d full(const Eigen::Vector2f& px) const;
  double moved_px(const PointTrack& track) const;

  StaticOverlayOptions options_;
  Camera camera_;
  std::uint64_t seed_;
  StandingPatches patches_;
  LensSpots spots_;
  int next_spots_ = 30;  // images of spots at which they are judged, then twice as many
  Image mask_;
  int frames_ = 0;
  int last_cells_ = 0;  // in the region at the last episode

  // The episode in progress.
  int reduction_;  // that of the images in which points are tracked
  PointTracker tracker_;
  std::map<LandmarkId, Eigen::Vector2d> px_ref_;  // at the beginning; empty: none in progress
  int begun_ = 0;                                 // comparison with which it began
  int without_result_ = 0;                        // episodes that say nothing, in succession
  int next_ = 0;                                  // comparison from which an episode may begin
  int tracked_images_ = 0;
};

/// The pixels that both masks use; an empty mask uses all.
Image both_masks(const Image& a, const Image& b);

}  // namespace placegraph
