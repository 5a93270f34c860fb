#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/slam_impl.h>

#include <algorithm>

namespace placegraph {

/// All or none in colour, as the first.
void Slam::Impl::keep_view(std::int64_t keyframe, const Frame& frame) {
  const auto span = times.measure("views of keyframes");
  if (!views_in_colour) views_in_colour = !frame.colour.empty();
  if (*views_in_colour && frame.colour.empty()) return;
  views[keyframe] =
      describe_place(*views_in_colour ? frame.colour : frame.image, options.views.cues, false);
}

/// Without its place.
Keyframe Slam::Impl::keyframe_of(const LoopCloser::View& view) const {
  Keyframe keyframe;
  keyframe.id = view.keyframe;
  keyframe.frame = view.frame;
  keyframe.stamp_ns = stamp_of_keyframe.at(view.keyframe);
  keyframe.features = view.features;
  if (const auto kept = views.find(view.keyframe); kept != views.end())
    keyframe.view = kept->second;
  return keyframe;
}

std::vector<PointLandmark> Slam::Impl::landmarks(std::size_t first) const {
  const std::size_t earlier = std::min(first, earlier_landmarks.size());
  std::vector<PointLandmark> result(
      earlier_landmarks.begin() + static_cast<std::ptrdiff_t>(earlier), earlier_landmarks.end());
  for (PointLandmark landmark : odometry.map().landmarks(first - earlier)) {
    landmark.id += first_landmark_id;
    result.push_back(landmark);
  }
  return result;
}

Map Slam::Impl::snapshot() const {
  Map map;
  map.place_graph = mapper.place_graph();
  label_environments(map.place_graph.places);
  std::map<std::int64_t, std::pair<std::int64_t, PlaceMember>> members;
  for (Place& place : map.place_graph.places) {
    place.appearance = closer.appearance(place.anchor_keyframe);
    for (const PlaceMember& member : place.members) members[member.keyframe] = {place.id, member};
  }
  for (const auto& view : closer.views()) {
    Keyframe& keyframe = map.keyframes.emplace_back(keyframe_of(view));
    const auto& [place, member] = members.at(view.keyframe);
    keyframe.place = place;
    keyframe.T_place_keyframe = member.T_place_keyframe;
    keyframe.scale = member.scale;
  }
  map.landmarks = landmarks(0);
  map.frames = records;
  map.loops = closer.records();
  map.metric = mapper.metric();
  map.trajectory_online = online;
  return map;
}

MapChanges Slam::Impl::take_changes() {
  MapChanges changes;
  changes.places = mapper.places();
  label_environments(changes.places);
  const bool described_anew = closer.trained_views() != untold.training;
  for (const Place& place : changes.places)
    if (described_places.insert(place.id).second || described_anew)
      changes.appearances.emplace_back(place.id, closer.appearance(place.anchor_keyframe));
  changes.constraints = mapper.take_constraint_changes();
  const auto& all = closer.views();
  for (std::size_t i = untold.view; i < all.size(); ++i)
    changes.keyframes.push_back(keyframe_of(all[i]));
  views.clear();
  changes.first_frame = untold.record;
  const auto from = static_cast<std::ptrdiff_t>(untold.record);
  changes.frames.assign(records.begin() + from, records.end());
  changes.online.assign(online.poses.begin() + from, online.poses.end());
  // Landmarks are saved a thousand together.
  changes.first_landmark = untold.landmark / 1000 * 1000;
  changes.landmarks = landmarks(changes.first_landmark);
  changes.loops = closer.records();
  changes.history = mapper.history();
  changes.history.median_depth_m = odometry.map().median_depth();
  changes.metric = mapper.metric();

  untold.training = closer.trained_views();
  untold.view = all.empty() ? 0 : all.size() - 1;  // its successor gives depth to its features
  untold.record = records.size();
  untold.landmark = earlier_landmarks.size() + odometry.map().settled_landmarks();
  return changes;
}

void Slam::Impl::go_on_from(const Map& map, const PlaceHistory& history, const Frame& last) {
  require(records.empty() && !finished, "Slam::go_on_from: after the first frame");
  require(!map.keyframes.empty() && map.keyframes.back().frame == last.id,
          "Slam::go_on_from: the frame is not that of the last keyframe");
  check_frame(last);
  mapper = PlaceMapper(options.places, options.pose_graph, map.place_graph.places, history);
  closer = LoopCloser(options.loops, calibration, options.seed, map);
  for (const Keyframe& keyframe : map.keyframes) {
    frame_of_keyframe[keyframe.id] = keyframe.frame;
    stamp_of_keyframe[keyframe.id] = keyframe.stamp_ns;
    if (!keyframe.view.empty() && !views_in_colour) views_in_colour = !keyframe.view.colour.empty();
  }
  for (std::size_t i = 0; i < map.frames.size() && map.frames[i].frame <= last.id; ++i) {
    records.push_back(map.frames[i]);
    online.poses.push_back(map.trajectory_online.poses.at(i));
  }
  for (const Place& place : map.place_graph.places) described_places.insert(place.id);
  earlier_landmarks = map.landmarks;
  for (const PointLandmark& landmark : map.landmarks)
    first_landmark_id = std::max(first_landmark_id, landmark.id + 1);
  last_keyframe = map.keyframes.back().id;
  posed_once = true;
  report(mapper.optimize());
  untold.record = records.size();
  untold.view = map.keyframes.size();
  untold.landmark = earlier_landmarks.size();
  untold.training = closer.trained_views();

  // Its pose is known but for rounding.
  constexpr double kSigmaDepths = 1e-5, kSigmaRad = 1e-5;
  const double sigma = kSigmaDepths * history.median_depth_m;
  bridge = Loop{-1, last_keyframe, SE3()};
  bridge->information.diagonal().head<3>().setConstant(1 / (sigma * sigma));
  bridge->information.diagonal().segment<3>(3).setConstant(1 / (kSigmaRad * kSigmaRad));
  taken_up = true;
  T_map_last = T_map_located(*bridge);
  odometry.go_on_from(last_keyframe + 1, history.median_depth_m);
  odometry.restart(T_map_last, true);
  FrameResult seen_again;
  add_keyframes(odometry.add_frame(last, T_map_last), seen_again);
  taken_up = false;
}

}  // namespace placegraph
