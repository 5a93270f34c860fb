#pragma once
#include <placegraph/backend/internal/window/distortion_evidence.h>
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/slam.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// What is left of radial distortion in images that should have none, from bundle adjustment over
/// windows that share no keyframe. Windows contradict each other by more than the noise of their
/// points explains (a rolling shutter, points that move): the deviation comes from their scatter.
class LensEstimator {
 public:
  /// Takes the evidence of a window, if its keyframes are all newer than those of the last one.
  void observe(const SlidingWindow& window);
  void add(const DistortionEvidence& evidence);
  /// The weighted mean of the windows; 0 before there are any.
  double k1() const;
  /// Infinite before there are four windows of like weight.
  double sigma_k1() const;
  /// See LensDistortion::effect.
  double effect() const;
  LensDistortion estimate() const { return {k1(), sigma_k1(), effect()}; }

 private:
  std::vector<DistortionEvidence> windows_;
  std::optional<KeyframeId> newest_;  // keyframe of the last window
};

}  // namespace placegraph
