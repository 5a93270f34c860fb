#pragma once
#include <placegraph/backend/evidence/nuisance_evidence.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/features/rgbd_errors.h>
#include <placegraph/graph/core/ids.h>

#include <map>
#include <optional>

namespace placegraph {

class NuisanceEquations;

/// Estimates the errors of an RGB-D camera (RgbdErrors) in motion, from bundle adjustment over its
/// windows with the errors as further unknowns: those of times show where the speed changes, those
/// of the calibration where the camera turns.
class RgbdCalibrator {
 public:
  /// `full`: number of keyframes of a full window.
  RgbdCalibrator(const Camera& camera, std::size_t full) : camera_(camera), full_(full) {}

  /// The errors that pixels and depths are corrected by; none until a window has shown any.
  const RgbdErrors& errors() const { return applied_; }
  /// Sets the velocity of the camera at a keyframe, before it is observed.
  void add_keyframe(KeyframeId keyframe, const Vector6d& twist) { twists_[keyframe] = twist; }
  /// Updates the estimate with the window and corrects all observations in the window accordingly;
  /// returns whether any has changed.
  bool calibrate(SlidingWindow& window);
  /// Notes how the motions between the keyframes of the optimized window depend on the errors.
  void add_motions(const SlidingWindow& window);
  /// Changes of the motions into keyframes from the ones before them, each in its right tangent, by
  /// what has been learned about the errors since the window was optimized with both for the last
  /// time. Motions that are as they were are left out.
  std::map<KeyframeId, Vector6d> corrections() const;

  struct Estimate {
    RgbdErrors::Vector errors;
    Eigen::Matrix<double, RgbdErrors::kParameters, RgbdErrors::kParameters> covariance;
    double dispersion = 0;  ///< mean square of the windows' differences in their deviations
  };
  /// The mean over the windows that share no keyframe, and `newest`, and a prior about zero. The
  /// windows' own errors are as large as their dispersion shows (a model of random effects).
  Estimate estimate(const std::optional<NuisanceEvidence>& newest) const;
  /// What is learned of the camera, and how the motions depend on it; not the window.
  void visit_state(auto& archive) { archive(applied_, windows_, newest_, motions_); }

 private:
  NuisanceEquations equations(const WindowState& state) const;
  NuisanceEvidence evidence(const SlidingWindow& window) const;
  void revise(const RgbdErrors& change, SlidingWindow& window) const;
  Vector6d twist(KeyframeId keyframe) const;

  RgbdErrors plausible(RgbdErrors::Vector errors) const;

  Camera camera_;
  std::size_t full_;
  RgbdErrors applied_;
  std::map<KeyframeId, Vector6d> twists_;  // keyframes of the window
  std::vector<NuisanceEvidence> windows_;  // about zero errors; they share no keyframe
  std::optional<KeyframeId> newest_;       // newest keyframe of the last of them
  struct Motion {
    Eigen::Matrix<double, 6, RgbdErrors::kParameters> by_errors = decltype(by_errors)::Zero();
    RgbdErrors::Vector corrected = RgbdErrors::Vector::Zero();  // errors that it was estimated with
    void visit_state(auto& archive) { archive(by_errors, corrected); }
  };
  std::map<KeyframeId, Motion> motions_;  // by the keyframe at the end
  std::size_t since_motions_ = 0;         // keyframes since their derivatives were computed
};

}  // namespace placegraph
