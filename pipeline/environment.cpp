#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues/surface_labels.h>
#include <placegraph/pipeline/environment.h>
#include <placegraph/pipeline/slam/environment_monitor.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// Keyframes on either side, every second one. Chosen.
constexpr std::ptrdiff_t kReach = 14, kStep = 2;

std::vector<Eigen::Vector3d> points_of(const Keyframe& keyframe) {
  std::vector<Eigen::Vector3d> points_cam;
  for (const Feature& feature : keyframe.features)
    if (feature.point_cam) points_cam.push_back(keyframe.scale * feature.point_cam->cast<double>());
  return points_cam;
}

/// Positions of the corners of an image in the camera frame, like the points of a run.
std::vector<Eigen::Vector3d> corner_points(const Frame& frame, const Camera& camera) {
  constexpr float kFarthest_m = 150;  // largest depth with a measurable parallax
  PointTracker tracker{PointTrackerOptions{}};
  tracker.track(frame.image);
  tracker.detect();
  std::vector<Eigen::Vector3d> points;
  for (const PointTrack& track : tracker.tracks()) {
    const auto u = static_cast<int>(std::lround(track.px.x()));
    const auto v = static_cast<int>(std::lround(track.px.y()));
    const float depth = frame.depth.at<float>(v, u);
    const auto ray = camera.unproject(track.px.cast<double>());
    if (depth > 0 && depth < kFarthest_m && ray)
      points.push_back(static_cast<double>(depth) * *ray);
  }
  return points;
}

}  // namespace

EnvironmentEvidence evidence_of_view(const Frame& frame, const Camera& camera,
                                     const std::shared_ptr<const SceneModel>& surfaces) {
  EnvironmentEvidence evidence;
  evidence.see(SurfaceLabeller(surfaces, {}).label(frame, false).shares);
  const auto [edges, of] = edges_of(frame.image, camera);
  evidence.see(edges, of);
  if (!frame.depth.empty()) evidence.see(corner_points(frame, camera), true);
  return evidence;
}

EnvironmentProbabilities environment_around(const Map& map, KeyframeId keyframe,
                                            const Camera& camera,
                                            const std::shared_ptr<const SceneModel>& surfaces,
                                            const std::function<Frame(const Keyframe&)>& frame_of) {
  const auto found = std::ranges::find(map.keyframes, keyframe, &Keyframe::id);
  require(found != map.keyframes.end(), "environment_around: unknown keyframe");
  const std::ptrdiff_t centre = found - map.keyframes.begin(), last = std::ssize(map.keyframes) - 1;
  const SurfaceLabeller labeller(surfaces, {});
  EnvironmentMonitor monitor({}, camera);
  std::size_t at = 0;
  for (std::ptrdiff_t i = centre - kReach; i <= std::min(last, centre + kReach); i += kStep) {
    if (i < 0) continue;
    const Keyframe& near = map.keyframes[static_cast<std::size_t>(i)];
    const Frame frame = frame_of(near);
    const SurfaceShares shares = labeller.label(frame, false).shares;
    if (i == centre) at = monitor.observations().size();
    monitor.classify(near.id, frame, &shares, points_of(near), map.metric);
  }
  std::vector<EnvironmentProbabilities> views;
  for (const EnvironmentObservation& observation : monitor.observations())
    views.push_back(observation.probabilities);
  return smoothed_kinds(views)[at];
}

}  // namespace placegraph
