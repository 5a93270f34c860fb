#pragma once
#include <placegraph/frontend/features/rgbd_errors.h>
#include <placegraph/frontend/places/verification/loop_verifier.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/loops/loop_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Features of a keyframe for place recognition and loop verification.
struct DescribedKeyframe {
  KeyframeId keyframe;
  FrameId frame;
  std::vector<Feature> features;
  std::vector<LineFeature> lines;      ///< empty for keyframes of a loaded map
  FrameErrors errors = FrameErrors();  ///< that the features are corrected by
  /// g of the surface g^T X = 1 of every feature; empty for keyframes of a loaded map.
  std::vector<Eigen::Vector3f> surfaces_cam = {};
  LoopView for_verification() const { return {features, lines}; }
};

/// The greatest depth of a feature, in the keyframe's scale; 0 without features.
double farthest_depth(const DescribedKeyframe& keyframe);
/// Multiplies all lengths of the keyframe by `factor`.
void rescale(DescribedKeyframe& keyframe, double factor);

/// Computes the features by which loops are found: points with descriptors and depth, and
/// descriptors of lines.
class KeyframeDescriber {
 public:
  KeyframeDescriber(const DetectorOptions& detector, const MatcherOptions& matcher,
                    const Calibration& calibration);

  const Camera& camera() const { return calibration_.camera; }
  /// Features of a frame; those covered by the depth image have their point in the camera's frame
  /// [m].
  std::vector<Feature> features(const Frame& frame) const;
  /// The same of a keyframe, corrected by `errors`, with lines that the odometry tracks in the
  /// frame; their descriptors are computed here.
  DescribedKeyframe describe(KeyframeId keyframe, const Frame& frame,
                             std::vector<LineFeature> lines,
                             const FrameErrors& errors = FrameErrors()) const;
  /// Corrects the features by what is known about the errors by now; returns whether that changed
  /// them.
  bool correct(DescribedKeyframe& keyframe, const RgbdErrors& errors) const;
  /// Computes depth from the parallax between consecutive keyframes, in the same manner for
  /// monocular and stereo cameras, for features observed in both whose rays meet at 0.7 degrees or
  /// more and within 2 px. A feature of the previous keyframe that has a depth keeps it. Does
  /// nothing if the calibration has a depth sensor.
  void triangulate(DescribedKeyframe& previous, DescribedKeyframe& current,
                   const SE3& T_previous_current) const;

 private:
  std::vector<Eigen::Vector3f> add_depths(const Frame& frame, const FrameErrors& frame_errors,
                                          std::vector<Feature>& features) const;

  DetectorOptions detector_;
  MatcherOptions matcher_;
  Calibration calibration_;
};

}  // namespace placegraph
