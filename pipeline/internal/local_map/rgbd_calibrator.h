#pragma once
#include <placegraph/backend/internal/evidence/nuisance_evidence.h>
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/features/rgbd_errors.h>
#include <placegraph/graph/core/ids.h>

#include <map>
#include <optional>

namespace placegraph {

/// Estimates the errors of an RGB-D camera (RgbdErrors) in motion, from bundle adjustment over its
/// windows with the errors as further unknowns: those of times show where the speed changes, those
/// of the calibration where the camera turns.
class RgbdCalibrator {
 public:
  /// `full`: number of keyframes of a full window.
  RgbdCalibrator(const Camera& camera, std::size_t full) : camera_(camera), full_(full) {}

  /// The errors that pixels and depths are corrected by: those that are significant, or none.
  const RgbdErrors& errors() const { return applied_; }
  /// Sets the velocity of the camera at a keyframe, before it is observed.
  void add_keyframe(KeyframeId keyframe, const Vector6d& twist) { twists_[keyframe] = twist; }
  /// Updates the estimate with the window and corrects all observations in the window accordingly;
  /// returns whether any has changed.
  bool calibrate(SlidingWindow& window);

  struct Estimate {
    RgbdErrors::Vector errors;
    Eigen::Matrix<double, RgbdErrors::kParameters, RgbdErrors::kParameters> covariance;
    double dispersion = 0;  ///< mean square of the windows' differences in their deviations
  };
  /// The mean over the windows that share no keyframe, and `newest`, and a prior about zero. The
  /// windows' own errors are as large as their dispersion shows (a model of random effects).
  Estimate estimate(const std::optional<NuisanceEvidence>& newest) const;

 private:
  NuisanceEvidence evidence(const SlidingWindow& window) const;
  void revise(const RgbdErrors::Vector& change, SlidingWindow& window) const;
  Vector6d twist(KeyframeId keyframe) const;

  RgbdErrors significant(const Estimate& found) const;

  Camera camera_;
  std::size_t full_;
  RgbdErrors applied_;
  std::map<KeyframeId, Vector6d> twists_;  // keyframes of the window
  std::vector<NuisanceEvidence> windows_;  // about zero errors; they share no keyframe
  std::optional<KeyframeId> newest_;       // newest keyframe of the last of them
};

}  // namespace placegraph
