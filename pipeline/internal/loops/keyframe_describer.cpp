#include <placegraph/frontend/internal/features/depth_lookup.h>
#include <placegraph/frontend/internal/features/detector.h>
#include <placegraph/frontend/internal/features/matcher.h>
#include <placegraph/frontend/internal/features/triangulation.h>
#include <placegraph/frontend/internal/lines/line_feature.h>
#include <placegraph/graph/internal/core/angle.h>
#include <placegraph/pipeline/internal/loops/keyframe_describer.h>

#include <algorithm>

namespace placegraph {

double farthest_depth(const DescribedKeyframe& keyframe) {
  double farthest = 0;
  for (const Feature& feature : keyframe.features)
    if (feature.point_cam) farthest = std::max<double>(farthest, feature.point_cam->z());
  return farthest;
}

void rescale(DescribedKeyframe& keyframe, double factor) {
  for (Feature& feature : keyframe.features)
    if (feature.point_cam) *feature.point_cam *= static_cast<float>(factor);
  for (LineFeature& line : keyframe.lines)
    if (line.line_cam)
      line.line_cam = Line3::from_direction(factor * line.line_cam->nearest_point(),
                                            line.line_cam->direction());
}

KeyframeDescriber::KeyframeDescriber(const DetectorOptions& detector, const MatcherOptions& matcher,
                                     const Calibration& calibration)
    : detector_(detector), matcher_(matcher), calibration_(calibration) {}

std::vector<Feature> KeyframeDescriber::features(const Frame& frame) const {
  std::vector<Feature> features = detect_features(frame.image, detector_, frame.mask);
  if (!calibration_.depth || frame.depth.empty()) return features;
  std::vector<Eigen::Vector2f> px;
  for (const Feature& feature : features) px.push_back(feature.px);
  const auto depths = lookup_depth(frame.depth, calibration_.camera, *calibration_.depth, px);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto ray = calibration_.camera.unproject(features[i].px.cast<double>());
    if (depths[i] && ray) features[i].point_cam = (*depths[i] * *ray).cast<float>();
  }
  return features;
}

DescribedKeyframe KeyframeDescriber::describe(KeyframeId keyframe, const Frame& frame,
                                              std::vector<LineFeature> lines) const {
  DescribedKeyframe described{keyframe, frame.id, features(frame), std::move(lines)};
  std::vector<LineSegment> segments;
  for (const LineFeature& line : described.lines) segments.push_back(line.segment);
  const auto descriptors = describe_segments(frame.image, segments);
  for (std::size_t i = 0; i < described.lines.size(); ++i)
    described.lines[i].descriptor = descriptors[i];
  return described;
}

void KeyframeDescriber::triangulate(DescribedKeyframe& previous, DescribedKeyframe& current,
                                    const SE3& T_previous_current) const {
  if (calibration_.depth) return;
  constexpr double kBandPx = 2.0, kMinParallaxRad = deg_to_rad(0.7);
  const SE3 T_current_previous = T_previous_current.inverse();
  for (const FeatureMatch& m :
       match_epipolar(calibration_.camera, previous.features, current.features, T_previous_current,
                      kBandPx, matcher_)) {
    Feature &before = previous.features[m.a], &now = current.features[m.b];
    const auto point = placegraph::triangulate(
        calibration_.camera,
        {{SE3(), before.px.cast<double>()}, {T_previous_current, now.px.cast<double>()}},
        kMinParallaxRad, kBandPx);
    if (!point.outcome) continue;
    if (!before.point_cam) before.point_cam = point.point_ref.cast<float>();
    now.point_cam = (T_current_previous * point.point_ref).cast<float>();
  }
}

}  // namespace placegraph
