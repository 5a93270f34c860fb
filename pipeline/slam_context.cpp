#include <placegraph/pipeline/slam_impl.h>

#include <algorithm>
#include <array>

// The kind of environment: told keyframe by keyframe, kept by places, assumed by the odometry.

namespace placegraph {

void Slam::Impl::look_around(const NewKeyframe& keyframe) {
  const auto span = times.measure("environment");
  EnvironmentSight sight{keyframe.id, keyframe.frame.id, {}, {}, {}};
  if (keyframe.labels) sight.evidence.see(keyframe.labels->shares);
  const auto [edges, camera] = edges_of(keyframe.frame.image, calibration.camera);
  sight.evidence.see(edges, camera);
  sight.evidence.see(odometry.points_cam(), odometry.map().metric());
  sight.probabilities = built_in_environments().probabilities(sight.evidence);
  const auto before = surroundings.kind();
  sight.kind = surroundings.add(sight.probabilities);
  environments.push_back(sight);
  if (sight.kind == before) return;
  log(log_sink, LogLevel::kInfo, "frame {}: environment {}", keyframe.frame.id,
      (sight.kind ? environment_name(*sight.kind) : std::string("unknown")));
  if (!options.context.assume) return;
  std::optional<Assumptions> assumptions;
  if (sight.kind) assumptions = assumptions_of(*sight.kind);
  odometry.assume(assumptions);
}

/// By the kind that most of a place's keyframes had; none where that is unknown.
void Slam::Impl::label_environments(std::vector<Place>& places) const {
  if (environments.empty()) return;
  for (Place& place : places) {
    std::array<int, kEnvironmentCount> votes{};
    int unknown = 0;
    for (const PlaceMember& member : place.members) {
      const auto sight = std::lower_bound(
          environments.begin(), environments.end(), member.keyframe,
          [](const EnvironmentSight& s, std::int64_t id) { return s.keyframe < id; });
      if (sight == environments.end() || sight->keyframe != member.keyframe) continue;
      if (sight->kind)
        ++votes[static_cast<std::size_t>(*sight->kind)];
      else
        ++unknown;
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    if (*most > unknown) label_environment(place, static_cast<Environment>(most - votes.begin()));
  }
}

}  // namespace placegraph
