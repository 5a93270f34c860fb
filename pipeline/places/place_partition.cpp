#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_partition.h>
#include <placegraph/pipeline/places/rescaling.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace placegraph {

PlacePartition::PlacePartition(const std::vector<Place>& places, const PlaceHistory& history)
    : merged_(history.merged), separated_(history.separated), founded_(history.founded) {
  require(places.size() == history.places.size(),
          "PlacePartition: places and their history differ in number");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    require(place.id == history.places[i].id, "PlacePartition: history of another place");
    places_[place.id] = {place.anchor_keyframe, place.S_map_place(), place.component,
                         history.places[i].reach, history.places[i].last_keyframe};
  }
  for (const auto& [anchor, place, S_place_segment, covariance, motion_covariance] :
       history.segments) {
    require(places_.count(place) == 1, "PlacePartition: a segment of an unknown place");
    segments_[anchor] = {place, S_place_segment, covariance, motion_covariance};
  }
  for (const PlaceHistory::Keyframe& keyframe : history.keyframes) {
    require(is_anchor(keyframe.segment),
            "PlacePartition: keyframe " + to_string(keyframe.id) + " has no segment");
    segment_of_[keyframe.id] = keyframe.segment;
  }
  for (const auto& [anchor, segment] : segments_)
    require(segment_of_.count(anchor) == 1 && segment_of(anchor) == anchor,
            "PlacePartition: a segment without its anchor");
  for (const PlaceHistory::Merged& merged : merged_) {
    bool known = is_anchor(merged.anchor);
    for (const auto& [anchor, covariance] : merged.covariance_of_segment)
      known &= is_anchor(anchor);
    require(known, "PlacePartition: an unknown segment was merged");
  }
  require(places_.empty() || founded_ > places_.rbegin()->first.value(),
          "PlacePartition: fewer places were founded than there are");
}

void PlacePartition::save(PlaceHistory& history) const {
  for (const auto& [anchor, segment] : segments_)
    history.segments.push_back({anchor, segment.place, segment.S_place_segment, segment.covariance,
                                segment.motion_covariance});
  for (const auto& [number, place] : places_)
    history.places.push_back({number, place.reach, place.last_keyframe});
  history.merged = merged_;
  history.separated = separated_;
  history.founded = founded_;
}

void PlacePartition::found(KeyframeId keyframe, const Sim3& S_map_place, int component,
                           double reach) {
  const PlaceId number(founded_++);
  segment_of_[keyframe] = keyframe;
  segments_[keyframe] = {number, Sim3()};
  places_[number] = {keyframe, S_map_place, component, reach, keyframe};
}

void PlacePartition::join(KeyframeId keyframe, KeyframeId anchor) {
  places_.at(segments_.at(anchor).place).last_keyframe = keyframe;
  segment_of_[keyframe] = anchor;
}

void PlacePartition::set_motion_covariance(KeyframeId anchor, const Matrix6d& covariance) {
  segments_.at(anchor).motion_covariance = covariance;
}

KeyframeId PlacePartition::merge(PlaceId older, PlaceId younger, const Matrix7d& covariance) {
  require(older != younger, "PlacePartition::merge: a place with itself");
  PlaceState& into = places_.at(older);
  const PlaceState& from = places_.at(younger);
  into.last_keyframe = std::max(into.last_keyframe, from.last_keyframe);
  const Sim3 S_older_younger = into.S_map_place.inverse() * from.S_map_place;
  PlaceHistory::Merged merged{from.anchor_keyframe, {}};
  for (auto& [anchor, segment] : segments_) {
    if (segment.place != younger) continue;
    merged.covariance_of_segment[anchor] = segment.covariance;
    const Matrix7d adjoint = segment.S_place_segment.inverse().adjoint();
    segment.covariance += adjoint * covariance * adjoint.transpose();
    segment.S_place_segment = S_older_younger * segment.S_place_segment;
    segment.place = older;
  }
  const KeyframeId first = merged.covariance_of_segment.begin()->first;
  merged_.push_back(std::move(merged));
  places_.erase(younger);
  return first;
}

KeyframeId PlacePartition::separate(std::size_t number, bool for_good) {
  const PlaceHistory::Merged merged = merged_.at(number);
  const PlaceId former = segments_.at(merged.anchor).place, again(founded_++);
  const Sim3 S_former_place = segments_.at(merged.anchor).S_place_segment;
  PlaceState place = places_.at(former);
  if (for_good) separated_.insert({place.anchor_keyframe, merged.anchor});
  place.anchor_keyframe = merged.anchor;
  place.S_map_place = place.S_map_place * S_former_place;
  place.reach /= S_former_place.scale();
  KeyframeId first = kAfterAll;
  for (const auto& [anchor, covariance] : merged.covariance_of_segment) {
    Segment& segment = segments_.at(anchor);
    if (segment.place != former) continue;
    segment.place = again;
    segment.S_place_segment = S_former_place.inverse() * segment.S_place_segment;
    segment.covariance = covariance;
    first = std::min(first, anchor);
  }
  place.last_keyframe = merged.anchor;
  for (const auto& [keyframe, anchor] : segment_of_)
    if (segments_.at(anchor).place == again) place.last_keyframe = keyframe;
  places_[again] = place;
  merged_.erase(merged_.begin() + static_cast<std::ptrdiff_t>(number));
  return first;
}

bool PlacePartition::were_separated(PlaceId one, PlaceId other) const {
  return std::any_of(separated_.begin(), separated_.end(), [&](const auto& anchors) {
    return std::minmax(segments_.at(anchors.first).place, segments_.at(anchors.second).place) ==
           std::minmax(one, other);
  });
}

void PlacePartition::set_pose(PlaceId place, const Sim3& S_map_place) {
  places_.at(place).S_map_place = S_map_place;
}

void PlacePartition::set_component(PlaceId place, int component) {
  places_.at(place).component = component;
}

void PlacePartition::move_component(int from, int to, const Sim3& S_new_old) {
  for (auto& [number, place] : places_)
    if (place.component == from) {
      place.S_map_place = S_new_old * place.S_map_place;
      place.component = to;
    }
}

void PlacePartition::drop_scales() {
  for (auto& [number, place] : places_) place.S_map_place = Sim3(rigid_part(place.S_map_place));
  for (auto& [anchor, segment] : segments_)
    segment.S_place_segment = Sim3(rigid_part(segment.S_place_segment));
}

void PlacePartition::rescale(const KeyframeChain& chain, KeyframeId first, double factor) {
  const auto in_track_segment = [&, track_segment =
                                        chain.at(first).track_segment](KeyframeId keyframe) {
    return chain.at(keyframe).track_segment == track_segment;
  };
  const int component = state_of(first).component;
  const Eigen::Vector3d centre = S_map_keyframe(chain, first).translation();
  bool alone = true;
  for (const auto& [keyframe, anchor] : segment_of_)
    alone &= in_track_segment(keyframe) || state_of(keyframe).component != component;

  for (auto& [anchor, segment] : segments_) {
    const Sim3& S = segment.S_place_segment;
    const double of_place =
                     in_track_segment(places_.at(segment.place).anchor_keyframe) ? factor : 1,
                 of_segment = in_track_segment(anchor) ? factor : 1;
    segment.S_place_segment =
        Sim3(S.rotation(), of_place * S.translation(), S.scale() * of_place / of_segment);
    if (!in_track_segment(anchor)) continue;
    segment.covariance = rescaled_covariance<7>(segment.covariance, factor);
    if (segment.motion_covariance)
      segment.motion_covariance = rescaled_covariance<6>(*segment.motion_covariance, factor);
  }
  for (PlaceHistory::Merged& merged : merged_)
    for (auto& [anchor, covariance] : merged.covariance_of_segment)
      if (in_track_segment(anchor)) covariance = rescaled_covariance<7>(covariance, factor);
  for (auto& [number, place] : places_) {
    if (!in_track_segment(place.anchor_keyframe)) continue;
    place.reach *= factor;
    const Sim3& S = place.S_map_place;
    place.S_map_place =
        alone ? Sim3(S.rotation(), centre + factor * (S.translation() - centre), S.scale())
              : Sim3(S.rotation(), S.translation(), S.scale() / factor);
  }
}

std::optional<KeyframeId> PlacePartition::previous_anchor(const KeyframeChain& chain,
                                                          KeyframeId anchor) const {
  if (!is_anchor(anchor) || !chain.has_odometry(anchor)) return std::nullopt;
  return segment_of(chain.at(anchor).link->from);
}

SE3 PlacePartition::T_segment_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const {
  return chain.T_a_b(segment_of(keyframe), keyframe);
}

Sim3 PlacePartition::S_place_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const {
  return segments_.at(segment_of(keyframe)).S_place_segment *
         Sim3(T_segment_keyframe(chain, keyframe));
}

Sim3 PlacePartition::S_map_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const {
  return state_of(keyframe).S_map_place * S_place_keyframe(chain, keyframe);
}

std::vector<Place> PlacePartition::graph_places(const KeyframeChain& chain) const {
  std::vector<Place> places;
  std::map<PlaceId, std::size_t> index;
  for (const auto& [number, state] : places_) {
    index[number] = places.size();
    Place place;
    place.id = number;
    place.anchor_keyframe = state.anchor_keyframe;
    place.T_map_place = rigid_part(state.S_map_place);
    place.scale = state.S_map_place.scale();
    place.component = state.component;
    places.push_back(std::move(place));
  }
  // An anchor is older than all keyframes that joined its place later.
  for (const auto& [keyframe, anchor] : segment_of_) {
    const Sim3 S = S_place_keyframe(chain, keyframe);
    places[index.at(place_of(keyframe))].members.push_back({keyframe, rigid_part(S), S.scale()});
  }
  return places;
}

}  // namespace placegraph
