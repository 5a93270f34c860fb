#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/local_map/lens_stretches.h>

#include <optional>

namespace placegraph {

/// Estimates the residual radial distortion of images that are expected to be undistorted, from
/// bundle adjustment over windows that share no keyframe.
///
/// Measured depths are those of the distorted pixels: on a street they look as if there were no
/// distortion. Images with depth are therefore examined with depths and without, and the clearer
/// one of the two estimates counts: depths hide distortion, but never feign it.
class LensEstimator {
 public:
  /// Adds the evidence of a window, if its keyframes are all newer than those of the last one;
  /// returns whether they are.
  bool observe(const SlidingWindow& window);
  LensDistortion estimate() const;
  void visit_state(auto& archive) { archive(points_, with_depth_, newest_); }

 private:
  LensStretches points_, with_depth_;
  std::optional<KeyframeId> newest_;  // newest keyframe of the last window
};

}  // namespace placegraph
