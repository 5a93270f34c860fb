#include "apps/viewer/live_map.h"

namespace placegraph::apps {

void LiveMap::clear() { *this = LiveMap(); }

const LiveMap::PlaceState* LiveMap::place_of(PlaceId id) const {
  const auto found = places_.find(id);
  return found == places_.end() ? nullptr : &found->second;
}

void LiveMap::add_place(const PlaceAdded& place) {
  places_[place.place] = {Sim3(place.T_map_place), place.component};
}

void LiveMap::add_keyframe(const KeyframeAdded& keyframe) { newest_ = keyframe.place; }

void LiveMap::merge(const PlacesMerged& places) {
  const PlaceState* kept = place_of(places.kept);
  const PlaceState* gone = place_of(places.gone);
  if (!kept || !gone) return;
  const Sim3 S_kept_gone = kept->S_map_place.inverse() * gone->S_map_place;
  for (FrameState& frame : frames_)
    if (frame.place == places.gone && frame.S_place_frame) {
      frame.place = places.kept;
      frame.S_place_frame = S_kept_gone * *frame.S_place_frame;
    }
  for (LandmarkState& landmark : landmarks_)
    if (landmark.place == places.gone) {
      landmark.place = places.kept;
      landmark.point_place = S_kept_gone * landmark.point_place;
    }
  if (newest_ == places.gone) newest_ = places.kept;
  places_.erase(places.gone);
}

void LiveMap::join(const ComponentJoined& component) {
  for (auto& [id, place] : places_)
    if (place.component == component.component) place.component = component.into;
}

void LiveMap::move(const MapMoved& moved) {
  const PlaceState* newest = place_of(newest_);
  if (moved.scale != 1 && newest) {
    // What hangs on places of this component is measured in its earlier unit.
    const int component = newest->component;
    const auto concerns = [&](PlaceId id) {
      const PlaceState* place = place_of(id);
      return place && place->component == component;
    };
    for (FrameState& frame : frames_)
      if (frame.S_place_frame && concerns(frame.place))
        frame.S_place_frame =
            Sim3(frame.S_place_frame->rotation(), moved.scale * frame.S_place_frame->translation(),
                 frame.S_place_frame->scale());
    for (LandmarkState& landmark : landmarks_)
      if (concerns(landmark.place)) landmark.point_place *= moved.scale;
  }
  for (const PlacePose& pose : moved.poses)
    if (const auto place = places_.find(pose.place); place != places_.end())
      place->second.S_map_place = pose.S_map_place;
}

std::vector<Eigen::Vector3d> LiveMap::add_frame(const FrameResult& result, const FrameView& view) {
  const TrackedFrame tracked{result.frame,    result.state, result.inliers,
                             result.keyframe, -1,           std::nullopt};
  FrameState& frame = frames_.emplace_back(FrameState{tracked, newest_, std::nullopt});
  const PlaceState* place = place_of(newest_);
  std::vector<Eigen::Vector3d> added;
  if (!result.T_map_cam || !place) return added;
  const Sim3 S_place_map = place->S_map_place.inverse();
  frame.S_place_frame = S_place_map * Sim3(*result.T_map_cam);
  if (!result.keyframe) return added;
  const Sim3 S_map_cam(result.T_map_cam->rotation(), result.T_map_cam->translation(),
                       place->S_map_place.scale());
  for (const FrameView::Track& track : view.tracks) {
    if (!track.point_cam || !known_.insert(track.id).second) continue;
    added.push_back(S_map_cam * *track.point_cam);
    landmarks_.push_back({newest_, S_place_map * added.back()});
  }
  return added;
}

std::vector<LiveMap::TrackedFrame> LiveMap::frames() const {
  std::vector<TrackedFrame> result;
  for (const FrameState& frame : frames_) {
    TrackedFrame& tracked = result.emplace_back(frame.tracked);
    const PlaceState* place = place_of(frame.place);
    if (!frame.S_place_frame || !place) continue;
    const Sim3 S = place->S_map_place * *frame.S_place_frame;
    tracked.component = place->component;
    tracked.pose = SE3(S.rotation(), S.translation());
  }
  return result;
}

std::vector<Eigen::Vector3d> LiveMap::landmarks() const {
  std::vector<Eigen::Vector3d> result;
  for (const LandmarkState& landmark : landmarks_)
    if (const PlaceState* place = place_of(landmark.place))
      result.push_back(place->S_map_place * landmark.point_place);
  return result;
}

}  // namespace placegraph::apps
