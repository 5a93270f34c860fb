#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/pipeline/lines/line_cue.h>

#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// Estimates the rectification error of a stereo camera in motion. Each landmark that has been
/// tracked for a few keyframes provides one sample: the difference between its disparity and the
/// disparity predicted from the motion of the left camera.
class StereoRectifier {
 public:
  /// `sigma_track_px`: standard deviation of a track in one image; `sigma_disparity_px`: standard
  /// deviation of a disparity.
  StereoRectifier(const RectificationOptions& options, const Calibration& calibration,
                  double sigma_track_px, double sigma_disparity_px);

  RectificationError error() const { return estimator_.error(); }
  /// Updates the estimate with the landmarks of the window, and with `lines` if given, and corrects
  /// all disparities in the window accordingly.
  void calibrate(SlidingWindow& window, LineCue* lines);
  /// What is learned of the pair; not the window.
  void visit_state(auto& archive) { archive(estimator_); }

 private:
  std::optional<DisparitySample> sample(const SlidingWindow& window, LandmarkId landmark) const;
  void revise_disparities(SlidingWindow& window, const RectificationError& before) const;

  Camera camera_;
  double baseline_m_, sigma_track_px_, sigma_disparity_px_;
  RectificationEstimator estimator_;
  std::set<LandmarkId> used_;  // landmarks of the window that have been used as samples
};

}  // namespace placegraph
