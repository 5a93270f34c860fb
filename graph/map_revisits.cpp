#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/map_revisits.h>
#include <placegraph/graph/place_transitions.h>

#include <cmath>
#include <numbers>
#include <set>
#include <unordered_map>

namespace placegraph {
namespace {

using Isometry = Eigen::Isometry3d;

/// A frame that later frames are compared with.
struct SeenFrame {
  FrameId frame;
  Isometry T_map_cam;
};

using Neighbours = std::unordered_map<PlaceId, std::set<PlaceId>>;

/// For every place: the place itself and the adjacent ones.
Neighbours neighbours_of(const Map& map) {
  Neighbours next_to;
  const auto join = [&](PlaceId a, PlaceId b) {
    next_to[a].insert(b);
    next_to[b].insert(a);
  };
  for (const Place& place : map.place_graph.places) join(place.id, place.id);
  for (const RelativePoseConstraint& constraint : map.place_graph.constraints)
    join(place_of_node(constraint.from), place_of_node(constraint.to));
  for (const PlaceTransition& transition : place_transitions(map))
    join(transition.from, transition.to);
  return next_to;
}

}  // namespace

void visit(OptionVisitor& field, MapRevisitOptions& o) {
  field("min_age", o.min_age, "minimum number of frames between the two visits", {1, 1e9});
  field("max_angle_deg", o.max_angle_deg, "largest angle between the two viewing directions [deg]",
        {0, 180});
}

std::vector<LoopPrediction> map_revisits(const Map& map, const MapRevisitOptions& options) {
  options.check();
  const double least_cosine = std::cos(deg_to_rad(options.max_angle_deg));
  const Trajectory trajectory = map.trajectory_optimized();
  const Neighbours next_to = neighbours_of(map);
  std::unordered_map<KeyframeId, PlaceId> place_of;
  for (const Keyframe& keyframe : map.keyframes) place_of[keyframe.id] = keyframe.place;

  std::unordered_map<PlaceId, std::vector<SeenFrame>> seen_in;  // by place, oldest first
  std::vector<LoopPrediction> revisits;
  for (std::size_t i = 0; i < map.frames.size(); ++i) {
    const auto& T_map_cam = trajectory.poses[i].T_world_body;
    if (!T_map_cam) continue;
    const FrameId frame = map.frames[i].frame;
    const PlaceId here = place_of.at(*map.frames[i].keyframe);
    const SeenFrame* nearest = nullptr;
    double least = 0;
    for (const PlaceId place : next_to.at(here)) {
      for (const SeenFrame& older : seen_in[place]) {
        if (older.frame.value() > frame.value() - options.min_age) break;
        const Isometry T_older_cam = older.T_map_cam.inverse() * *T_map_cam;
        const double distance = T_older_cam.translation().norm();
        // The angle of a rotation by its trace.
        if (0.5 * (T_older_cam.linear().trace() - 1) < least_cosine) continue;
        if (nearest && distance >= least) continue;
        nearest = &older;
        least = distance;
      }
    }
    if (nearest) revisits.push_back({frame, nearest->frame, 1 / (1 + least), {}, 0});
    seen_in[here].push_back({frame, *T_map_cam});
  }
  return revisits;
}

}  // namespace placegraph
