#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/cues/direct_cue.h>

namespace placegraph {

/// Direct alignment as an additional cue: adds the motion between two keyframes, estimated from the
/// intensities of surfaces, to the window. The map must be metric.
class KeyframeAlignment {
 public:
  KeyframeAlignment(const DirectCueOptions& options, const Calibration& calibration,
                    const StereoMatcherOptions& stereo);

  struct Keyframe {
    KeyframeId id;
    Frame frame;
    Image ground;                       ///< 0 = no ground, CV_8UC1 of the image's size, or empty
    std::vector<KnownPixel> landmarks;  ///< landmarks observed in the keyframe
  };
  /// Aligns the newest keyframe of the window with `previous`, if there is one, and makes it the
  /// reference of the next.
  void add(const Keyframe& keyframe, const std::optional<KeyframeId>& previous,
           const RectificationError& rectification, SlidingWindow& window, Random& random);
  /// Pixels of the last alignment.
  std::vector<FrameView::SurfacePixel> view() const { return cue_.view(newest_); }
  void forget_newest() { newest_ = DirectMotion(); }
  void reset();

 private:
  DirectCue cue_;
  bool measures_depth_;  // otherwise the map's scale comes from the camera's height
  DirectMotion newest_;  // motion from the previous keyframe
};

}  // namespace placegraph
