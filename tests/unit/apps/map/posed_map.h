#pragma once
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/synthetic/writers/sequence_writer.h>

#include <string>

namespace placegraph::test {

/// A saved map of a rendered sequence in the folder `sequence`, as a run that errs nowhere would
/// make it: every `step`-th frame is a keyframe and a place at its true pose, without features.
inline StoredMap posed_map(const SyntheticWorld& world, const std::string& sequence, Sensor sensor,
                           int step) {
  StoredMap stored;
  stored.origin.sequence = sequence;
  stored.origin.sensor = sensor;
  stored.origin.calibration = world.calibration();
  if (sensor != Sensor::kRgbd) stored.origin.calibration->depth.reset();
  Map& map = stored.map;
  map.metric = true;
  const Trajectory truth = world.ground_truth();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::int64_t frame = static_cast<std::int64_t>(i), id = frame / step;
    const SE3 T_map_cam(*truth.poses[i].T_world_body);
    if (frame % step == 0) {
      Keyframe keyframe;
      keyframe.id = KeyframeId(id);
      keyframe.place = PlaceId(id);
      keyframe.frame = FrameId(frame);
      keyframe.stamp_ns = truth.poses[i].stamp_ns;
      map.keyframes.push_back(keyframe);
      Place place;
      place.id = PlaceId(id);
      place.anchor_keyframe = KeyframeId(id);
      place.T_map_place = T_map_cam;
      place.members = {{KeyframeId(id), SE3(), 1}};
      map.place_graph.places.push_back(place);
    }
    const SE3 T_map_keyframe = map.place_graph.places.back().T_map_place;
    map.frames.push_back({FrameId(frame), truth.poses[i].stamp_ns, KeyframeId(id),
                          T_map_keyframe.inverse() * T_map_cam, 50});
  }
  map.trajectory_online = truth;
  return stored;
}

}  // namespace placegraph::test
