#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/features/rectification.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/pipeline/internal/lines/line_cue.h>

#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// Calibrates the rectification of a stereo camera while it moves. Landmarks that have been tracked
/// for a few keyframes tell, once each, how far their disparity is from what the motion of the left
/// camera says of their depth.
class StereoRectifier {
 public:
  /// `sigma_track_px`: of a track in one image; `sigma_disparity_px`: of a disparity.
  StereoRectifier(const RectificationOptions& options, const Calibration& calibration,
                  double sigma_track_px, double sigma_disparity_px);

  RectificationError error() const { return estimator_.error(); }
  /// Learns from the landmarks of the window, and of `lines` if it is given, and corrects all
  /// disparities in the window by what it has learnt.
  void calibrate(SlidingWindow& window, LineCue* lines);

 private:
  std::optional<DisparitySample> sample(const SlidingWindow& window, LandmarkId landmark) const;
  void revise_disparities(SlidingWindow& window, const RectificationError& before) const;

  Camera camera_;
  double baseline_m_, sigma_track_px_, sigma_disparity_px_;
  RectificationEstimator estimator_;
  std::set<LandmarkId> used_;  // landmarks of the window that have been samples
};

}  // namespace placegraph
