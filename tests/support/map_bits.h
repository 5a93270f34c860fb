#pragma once
#include <placegraph/graph/map.h>

#include <string>

namespace placegraph::test {

/// The bytes of everything a run has estimated, in one string: equal if and only if every number is
/// the same to the last bit.
inline std::string map_bits(const Map& map) {
  std::string bits;
  const auto put = [&](const auto& value) {
    bits.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const auto put_pose = [&](const SE3& T) {
    for (int i = 0; i < 4; ++i) put(T.rotation().quaternion().coeffs()[i]);
    for (int i = 0; i < 3; ++i) put(T.translation()[i]);
  };
  const auto put_trajectory = [&](const Trajectory& trajectory) {
    for (const StampedPose& pose : trajectory.poses) {
      put(pose.stamp_ns);
      put(pose.T_world_body.has_value());
      if (pose.T_world_body)
        for (int i = 0; i < 12; ++i) put(pose.T_world_body->matrix()(i % 3, i / 3));
    }
  };
  put_trajectory(map.trajectory_online);
  put_trajectory(map.trajectory_optimized());
  for (const Keyframe& keyframe : map.keyframes) {
    put(keyframe.id), put(keyframe.frame), put(keyframe.place);
    put_pose(keyframe.T_place_keyframe);
    put(keyframe.scale);
    for (const Feature& feature : keyframe.features) {
      put(feature.px.x()), put(feature.px.y());
      for (const auto word : feature.descriptor) put(word);
      if (feature.point_cam)
        for (int i = 0; i < 3; ++i) put((*feature.point_cam)[i]);
    }
  }
  for (const Place& place : map.place_graph.places) {
    put(place.id), put(place.component);
    put_pose(place.T_map_place);
    put(place.scale);
    for (const auto& [word, weight] : place.appearance.words) put(word), put(weight);
  }
  for (const RelativePoseConstraint& c : map.place_graph.constraints) {
    put(c.from), put(c.to);
    if (const Sim3* S_from_to = std::get_if<Sim3>(&c.T_from_to)) {
      put_pose(SE3(S_from_to->rotation(), S_from_to->translation()));
      put(S_from_to->scale());
    } else {
      put_pose(std::get<SE3>(c.T_from_to));
    }
    for (Eigen::Index i = 0; i < c.information.size(); ++i) put(c.information.data()[i]);
  }
  for (const LoopRecord& loop : map.loops) {
    put(loop.query_frame), put(loop.match_frame), put(loop.inliers), put(loop.stage);
    put_pose(loop.T_match_query);
    put(loop.lines), put(loop.similarity), put(loop.probability);
  }
  return bits;
}

}  // namespace placegraph::test
