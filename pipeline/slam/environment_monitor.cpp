#include <placegraph/pipeline/cues/surface_labels.h>
#include <placegraph/pipeline/slam/environment_monitor.h>

#include <algorithm>

namespace placegraph {

bool EnvironmentMonitor::classify(KeyframeId keyframe, const Frame& frame,
                                  const SurfaceShares* shares,
                                  const std::vector<Eigen::Vector3d>& points_cam, bool metric) {
  EnvironmentObservation observation{keyframe, frame.id, {}, {}, {}};
  if (shares) observation.evidence.see(*shares);
  const auto [edges, camera] = edges_of(frame.image, camera_);
  observation.evidence.see(edges, camera);
  observation.evidence.see(points_cam, metric);
  observation.probabilities = built_in_environments().probabilities(observation.evidence);
  const auto before = filter_.kind();
  observation.kind = filter_.add(observation.probabilities);
  observations_.push_back(observation);
  return observation.kind != before;
}

void EnvironmentMonitor::label(std::vector<Place>& places) const {
  if (observations_.empty()) return;
  for (Place& place : places) {
    std::array<int, kEnvironmentCount> votes{};
    int unknown = 0;
    for (const PlaceMember& member : place.members) {
      const auto seen = std::lower_bound(
          observations_.begin(), observations_.end(), member.keyframe,
          [](const EnvironmentObservation& o, KeyframeId id) { return o.keyframe < id; });
      if (seen == observations_.end() || seen->keyframe != member.keyframe) continue;
      if (seen->kind)
        ++votes[static_cast<std::size_t>(*seen->kind)];
      else
        ++unknown;
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    if (*most > unknown) label_environment(place, static_cast<Environment>(most - votes.begin()));
  }
}

}  // namespace placegraph
