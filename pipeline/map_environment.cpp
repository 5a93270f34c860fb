#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map_environment.h>
#include <placegraph/pipeline/slam/environment_monitor.h>

#include <algorithm>

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

}  // namespace

EnvironmentProbabilities environment_around(const Map& map, KeyframeId keyframe,
                                            const Camera& camera, const SurfaceLabeller& labeller,
                                            const std::function<Frame(const Keyframe&)>& frame_of) {
  const auto found = std::ranges::find(map.keyframes, keyframe, &Keyframe::id);
  require(found != map.keyframes.end(), "environment_around: unknown keyframe");
  const std::ptrdiff_t centre = found - map.keyframes.begin(), last = std::ssize(map.keyframes) - 1;
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
