#pragma once
#include <placegraph/frontend/internal/places/verification/loop_verifier.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/loops/loop_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A keyframe as place recognition and loop verification see it.
struct DescribedKeyframe {
  KeyframeId keyframe;
  FrameId frame;
  std::vector<Feature> features;
  std::vector<LineFeature> lines;  ///< not those of a map that was read
  LoopView for_verification() const { return {features, lines}; }
};

/// The greatest depth of a feature, in the keyframe's unit; 0 without any.
double farthest_depth(const DescribedKeyframe& keyframe);
/// All lengths of the keyframe times `factor`.
void rescale(DescribedKeyframe& keyframe, double factor);

/// Makes of an image what loops are found by: features with descriptors, their depth, and
/// descriptors of lines.
class KeyframeDescriber {
 public:
  KeyframeDescriber(const DetectorOptions& detector, const MatcherOptions& matcher,
                    const Calibration& calibration);

  const Camera& camera() const { return calibration_.camera; }
  /// Features of a frame; those that the depth image covers have their point in the camera's frame
  /// [m].
  std::vector<Feature> features(const Frame& frame) const;
  /// The same with lines that the odometry follows there; their descriptors are made here.
  DescribedKeyframe describe(KeyframeId keyframe, const Frame& frame,
                             std::vector<LineFeature> lines) const;
  /// Depth by parallax between neighbours, the same way for one camera and for two: of the features
  /// that both see, where the rays meet at 0.7 degrees or more and within 2 px. A feature of the
  /// previous keyframe keeps the depth it has. Does nothing if the calibration has a depth sensor.
  void triangulate(DescribedKeyframe& previous, DescribedKeyframe& current,
                   const SE3& T_previous_current) const;

 private:
  DetectorOptions detector_;
  MatcherOptions matcher_;
  Calibration calibration_;
};

}  // namespace placegraph
