#include <placegraph/pipeline/slam/event_feed.h>

#include <algorithm>

namespace placegraph {

EventFeed::Places EventFeed::places_of(const PlaceMapper& mapper) {
  Places places;
  for (const Place& place : mapper.places())
    places[place.id] = {place.anchor_keyframe, place.T_map_place, place.scale, place.component};
  return places;
}

void EventFeed::take_up(const PlaceMapper& mapper, const std::vector<LoopRecord>& loops) {
  if (!events_) return;
  places_ = places_of(mapper);
  records_ = loops.size();
}

void EventFeed::keyframe_added(KeyframeId keyframe, FrameId frame, const PlaceMapper& mapper) {
  if (!events_) return;
  events_->keyframe_added(
      {keyframe, frame, mapper.place_of(keyframe), mapper.T_map_keyframe(keyframe)});
}

void EventFeed::places_changed(const PlaceMapper& mapper, double scale) {
  if (!events_) return;
  const Places now = places_of(mapper);
  for (const auto& [id, place] : now)
    if (!places_.count(id))
      events_->place_added({id, place.anchor, place.T_map_place, place.component});
  std::map<int, int> joined;
  MapMoved moved;
  moved.scale = scale;
  for (const auto& [id, before] : places_) {
    const auto place = now.find(id);
    if (place == now.end()) {
      const PlaceId kept = mapper.place_of(before.anchor);
      events_->places_merged({kept, id});
      if (const int into = now.at(kept).component; into != before.component)
        joined.emplace(before.component, into);
      continue;
    }
    if (place->second.component != before.component)
      joined.emplace(before.component, place->second.component);
    const SE3 T_before_now = before.T_map_place.inverse() * place->second.T_map_place;
    const double translation = T_before_now.translation().norm(),
                 rotation = T_before_now.rotation().log().norm();
    if (translation == 0 && rotation == 0 && before.scale == place->second.scale) continue;
    ++moved.places;
    const SE3& T = place->second.T_map_place;
    moved.poses.push_back({id, Sim3(T.rotation(), T.translation(), place->second.scale)});
    moved.translation = std::max(moved.translation, translation);
    moved.rotation_rad = std::max(moved.rotation_rad, rotation);
  }
  for (const auto& [component, into] : joined) events_->component_joined({component, into});
  if (moved.places > 0 || scale != 1) events_->map_moved(moved);
  places_ = now;
}

void EventFeed::loops_decided(const std::vector<LoopRecord>& records) {
  if (!events_) return;
  constexpr std::size_t kMostPending = 1000;  // support arrives within some keyframes or never
  while (pending_.size() > kMostPending) pending_.erase(pending_.begin());
  for (auto record = pending_.begin(); record != pending_.end();) {
    const bool accepted = records[*record].accepted();
    if (accepted) events_->loop_accepted(records[*record]);
    record = accepted ? pending_.erase(record) : std::next(record);
  }
  for (; records_ < records.size(); ++records_) {
    const LoopRecord& record = records[records_];
    if (record.stage == LoopStage::kSupport) pending_.insert(records_);
    record.accepted() ? events_->loop_accepted(record) : events_->loop_refused(record);
  }
}

void EventFeed::frame_done(const FrameResult& frame) {
  if (!events_) return;
  frame.T_map_cam ? events_->frame_posed(frame) : events_->frame_lost(frame);
}

}  // namespace placegraph
