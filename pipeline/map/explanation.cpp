#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/pipeline/map/explanation.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Covariance of a place's pose; nothing if the graph does not contain it, or is over similarities.
std::optional<Matrix6d> covariance_of(const PlaceGraph& places, PlaceId place) {
  const PoseGraph graph = places.pose_graph();
  if (graph.kind() != PoseKind::kSE3) return std::nullopt;
  const PoseMarginals marginals(graph);
  if (!marginals.outcome()) return std::nullopt;
  return Matrix6d(marginals.covariance(node_of_place(place)));
}

void place_frame(const Map& map, const FrameRecord& record, Explanation& explanation) {
  const Keyframe& keyframe = *map.find_keyframe(record.keyframe.value());
  const Place& place = *map.place_graph.find(keyframe.place);
  const Sim3 S_map_keyframe = map.S_map_keyframe(keyframe.id);
  const Sim3 S_map_cam = S_map_keyframe * Sim3(*record.T_keyframe_frame);
  explanation.posed = true;
  explanation.keyframe = keyframe.id;
  explanation.place = place.id;
  explanation.labels = place.labels;
  const auto position = std::find_if(map.place_graph.places.begin(), map.place_graph.places.end(),
                                     [&](const Place& other) { return other.id == place.id; });
  explanation.component =
      map.place_graph
          .joined_components()[static_cast<std::size_t>(position - map.place_graph.places.begin())];
  explanation.T_map_cam = SE3(S_map_cam.rotation(), S_map_cam.translation());
  explanation.distance_to_keyframe =
      S_map_keyframe.scale() * record.T_keyframe_frame->translation().norm();
  if (const auto of_place = covariance_of(map.place_graph, place.id)) {
    const Matrix6d to_cam = (explanation.T_map_cam.inverse() * place.T_map_place).adjoint();
    explanation.covariance = to_cam * *of_place * to_cam.transpose();
  }
  explanation.features = static_cast<int>(keyframe.features.size());
  explanation.features_placed = static_cast<int>(
      std::count_if(keyframe.features.begin(), keyframe.features.end(),
                    [](const Feature& feature) { return feature.point_cam.has_value(); }));
  for (const RelativePoseConstraint& constraint : map.place_graph.constraints)
    if (place_of_node(constraint.from) == place.id || place_of_node(constraint.to) == place.id)
      ++explanation.constraints[to_string(constraint.source)];
}

}  // namespace

std::optional<Explanation> explain_frame(const Map& map, FrameId frame) {
  const auto record =
      std::lower_bound(map.frames.begin(), map.frames.end(), frame,
                       [](const FrameRecord& r, FrameId id) { return r.frame < id; });
  if (record == map.frames.end() || record->frame != frame) return std::nullopt;
  Explanation explanation;
  explanation.frame = record->frame;
  explanation.stamp_ns = record->stamp_ns;
  explanation.inliers = record->inliers;
  FrameId frame_of_keyframe = frame;
  if (record->T_keyframe_frame) {
    place_frame(map, *record, explanation);
    frame_of_keyframe = map.find_keyframe(*record->keyframe)->frame;
  }
  const auto about = [&](FrameId other) { return other == frame || other == frame_of_keyframe; };
  for (const LoopRecord& loop : map.loops) {
    if (loop.accepted() && (about(loop.query_frame) || about(loop.match_frame)))
      explanation.loops.push_back(loop);
    else if (about(loop.query_frame))
      explanation.refused.push_back(loop);
  }
  return explanation;
}

}  // namespace placegraph
