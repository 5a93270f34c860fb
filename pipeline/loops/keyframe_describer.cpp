#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/frontend/features/detector.h>
#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/features/triangulation.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/loops/keyframe_describer.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Depth [m] of points that no depth image shows.
constexpr double kFar_m = 1e3;

}  // namespace

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
  add_depths(frame, FrameErrors(), features);
  return features;
}

/// Sets the points of the features that the depth image covers, and moves all features to where
/// they would be without the errors. Returns the surfaces of the features.
std::vector<Eigen::Vector3f> KeyframeDescriber::add_depths(const Frame& frame,
                                                           const FrameErrors& frame_errors,
                                                           std::vector<Feature>& features) const {
  if (!calibration_.depth || frame.depth.empty()) return {};
  const auto& [errors, twist] = frame_errors;
  const Camera& camera = calibration_.camera;
  const auto corrected = [&, &errors = errors, &twist = twist](const Feature& feature,
                                                               double depth_m) {
    const Eigen::Vector2d px = feature.px.cast<double>();
    const auto ray = errors.any() ? camera.unproject(px) : std::nullopt;
    return ray ? Eigen::Vector2d(px - errors.displacement_px(camera, px, depth_m * *ray, twist))
               : px;
  };
  std::vector<Eigen::Vector2f> px;
  for (const Feature& feature : features) px.push_back(corrected(feature, kFar_m).cast<float>());
  const auto surfaces =
      lookup_surfaces(frame.depth, camera, errors.corrected(*calibration_.depth, twist), px);
  std::vector<Eigen::Vector3f> planes(features.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < features.size(); ++i) {
    Feature& feature = features[i];
    const double depth_m = surfaces[i] ? surfaces[i]->depth_m : kFar_m;
    if (errors.any()) feature.px = corrected(feature, depth_m).cast<float>();
    const auto ray = camera.unproject(feature.px.cast<double>());
    if (!surfaces[i] || !ray) continue;
    feature.point_cam = (depth_m * *ray).cast<float>();
    planes[i] = plane_through(camera, *ray, *surfaces[i]).cast<float>();
  }
  return planes;
}

bool KeyframeDescriber::correct(DescribedKeyframe& keyframe, const RgbdErrors& errors) const {
  const RgbdErrors change(errors.values() - keyframe.errors.errors.values());
  if (!change.any() || keyframe.surfaces_cam.size() != keyframe.features.size()) return false;
  const Camera& camera = calibration_.camera;
  for (std::size_t i = 0; i < keyframe.features.size(); ++i) {
    Feature& feature = keyframe.features[i];
    const Eigen::Vector2d px = feature.px.cast<double>();
    const auto ray = camera.unproject(px);
    if (!ray) continue;
    const double depth_m = feature.point_cam ? feature.point_cam->z() : kFar_m;
    const Eigen::Vector3d moved = change.effect(camera, px, depth_m * *ray, keyframe.errors.twist,
                                                keyframe.surfaces_cam[i].cast<double>());
    feature.px = (px - moved.head<2>()).cast<float>();
    const auto corrected = camera.unproject(feature.px.cast<double>());
    const double inverse_depth = 1 / depth_m - moved.z();
    if (feature.point_cam && corrected && inverse_depth > 0)
      feature.point_cam = (*corrected / inverse_depth).cast<float>();
  }
  keyframe.errors.errors = errors;
  return true;
}

DescribedKeyframe KeyframeDescriber::describe(KeyframeId keyframe, const Frame& frame,
                                              std::vector<LineFeature> lines,
                                              const FrameErrors& errors) const {
  DescribedKeyframe described{
      keyframe, frame.id, detect_features(frame.image, detector_, frame.mask), std::move(lines)};
  described.surfaces_cam = add_depths(frame, errors, described.features);
  if (!described.surfaces_cam.empty()) described.errors = errors;
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
  // Distance from the epipolar line, and angle between the rays of a point. Chosen.
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
