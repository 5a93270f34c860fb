#pragma once
#include <placegraph/backend/internal/window/distortion_evidence.h>
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/slam.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// Estimates the residual radial distortion of images that are expected to be undistorted, from
/// bundle adjustment over windows that share no keyframe. Windows differ by more than the noise of
/// their points explains (a rolling shutter, points that move): the standard deviation is computed
/// from their dispersion.
class LensEstimator {
 public:
  /// Adds the evidence of a window, if its keyframes are all newer than those of the last one.
  void observe(const SlidingWindow& window);
  void add(const DistortionEvidence& evidence);
  /// Weighted mean over the windows; 0 before the first one.
  double k1() const;
  /// Standard deviation of k1; infinite before there are four windows of similar weight.
  double sigma_k1() const;
  /// See LensDistortion::effect.
  double effect() const;
  LensDistortion estimate() const { return {k1(), sigma_k1(), effect()}; }

 private:
  std::vector<DistortionEvidence> windows_;
  std::optional<KeyframeId> newest_;  // newest keyframe of the last window
};

}  // namespace placegraph
