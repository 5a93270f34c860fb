#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/io/map/stored_map.h>

#include <algorithm>

#include "tests/support/place_links.h"

namespace placegraph::test {

/// What a keyframe sees of a box of random points; `seed`: the places and looks of the points.
inline std::vector<Feature> features_of_box(const Camera& camera, std::uint64_t seed) {
  Random random(seed);
  std::vector<Feature> features(60);
  for (Feature& feature : features) {
    const Eigen::Vector3d point(random.uniform(-4, 4), random.uniform(-3, 3),
                                random.uniform(5, 15));
    feature.px = camera.project(point)->cast<float>();
    feature.point_cam = point.cast<float>();
    for (std::uint64_t& word : feature.descriptor)
      word = static_cast<std::uint64_t>(random.next()) << 32 | random.next();
  }
  return features;
}

/// The saved map of a run along square(), whose odometry does not close. Keyframe k is frame 10 k;
/// keyframes 0 and 4 show the same points, and `with_loop`: there is a loop between them that is
/// 3 m wrong.
inline StoredMap square_map(bool with_loop) {
  PlaceMapper mapper = square();
  if (with_loop) mapper.add_loop(loop(4, 0, pose({0, 0, 0}, {3, 0, 0}), 0.01, 0.001));
  (void)mapper.finish();
  StoredMap stored;
  stored.origin.sequence = "/data/no-such-recording";
  stored.origin.options = "places:\n  merge: false\nloops:\n  database:\n    first_training: 4\n";
  Camera& camera = stored.origin.calibration.emplace().camera;
  camera = {640, 480, 400, 400, 320, 240, Distortion::kNone, {}};
  stored.history = mapper.history();
  Map& map = stored.map;
  map.place_graph = mapper.place_graph();
  map.metric = mapper.metric();
  for (const Place& place : map.place_graph.places)
    for (const PlaceMember& member : place.members) {
      const std::int64_t id = member.keyframe.value();
      Keyframe& keyframe = map.keyframes.emplace_back();
      keyframe.id = member.keyframe;
      keyframe.frame = FrameId(10 * id);
      keyframe.stamp_ns = 1000 * id;
      keyframe.place = place.id;
      keyframe.T_place_keyframe = member.T_place_keyframe;
      keyframe.features = features_of_box(camera, static_cast<std::uint64_t>(id == 4 ? 0 : id));
    }
  std::ranges::sort(map.keyframes, {}, &Keyframe::id);
  for (const Keyframe& keyframe : map.keyframes) {
    map.frames.push_back({keyframe.frame, keyframe.stamp_ns, keyframe.id, SE3(), 50});
    map.trajectory_online.poses.push_back({keyframe.stamp_ns, std::nullopt});
  }
  if (!with_loop) return stored;
  LoopRecord& record = map.loops.emplace_back();
  record.query_frame = FrameId(40);
  record.match_frame = FrameId(0);
  record.stage = LoopStage::kAccepted;
  record.T_match_query = stored.history.loops.front().T_match_query;
  return stored;
}

}  // namespace placegraph::test
