#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/internal/places/place_partition.h>
#include <placegraph/pipeline/internal/places/rescaling.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace placegraph {

PlacePartition::PlacePartition(const std::vector<Place>& places, const PlaceHistory& history)
    : merged_(history.merged), parted_(history.parted), founded_(history.founded) {
  require(places.size() == history.places.size(),
          "PlacePartition: places and their history differ in number");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    require(place.id == history.places[i].id, "PlacePartition: history of another place");
    places_[place.id] = {place.anchor_keyframe, place.S_map_place(), place.component,
                         history.places[i].reach, history.places[i].last_keyframe};
  }
  for (const auto& [anchor, place, S_place_part, covariance, motion_covariance] : history.parts) {
    require(places_.count(place) == 1, "PlacePartition: a part of an unknown place");
    parts_[anchor] = {place, S_place_part, covariance, motion_covariance};
  }
  for (const PlaceHistory::Keyframe& keyframe : history.keyframes) {
    require(is_anchor(keyframe.part),
            "PlacePartition: keyframe " + to_string(keyframe.id) + " has no part");
    part_of_[keyframe.id] = keyframe.part;
  }
  for (const auto& [anchor, part] : parts_)
    require(part_of_.count(anchor) == 1 && part_of(anchor) == anchor,
            "PlacePartition: a part without its anchor");
  for (const PlaceHistory::Merged& merged : merged_) {
    bool known = is_anchor(merged.anchor);
    for (const auto& [anchor, covariance] : merged.covariance_of_part) known &= is_anchor(anchor);
    require(known, "PlacePartition: an unknown part was merged");
  }
  require(places_.empty() || founded_ > places_.rbegin()->first.value(),
          "PlacePartition: fewer places were founded than there are");
}

void PlacePartition::save(PlaceHistory& history) const {
  for (const auto& [anchor, part] : parts_)
    history.parts.push_back(
        {anchor, part.place, part.S_place_part, part.covariance, part.motion_covariance});
  for (const auto& [number, place] : places_)
    history.places.push_back({number, place.reach, place.last_keyframe});
  history.merged = merged_;
  history.parted = parted_;
  history.founded = founded_;
}

void PlacePartition::found(KeyframeId keyframe, const Sim3& S_map_place, int component,
                           double reach) {
  const PlaceId number(founded_++);
  part_of_[keyframe] = keyframe;
  parts_[keyframe] = {number, Sim3()};
  places_[number] = {keyframe, S_map_place, component, reach, keyframe};
}

void PlacePartition::join(KeyframeId keyframe, KeyframeId anchor) {
  places_.at(parts_.at(anchor).place).last_keyframe = keyframe;
  part_of_[keyframe] = anchor;
}

void PlacePartition::set_motion_covariance(KeyframeId anchor, const Matrix6d& covariance) {
  parts_.at(anchor).motion_covariance = covariance;
}

KeyframeId PlacePartition::merge(PlaceId older, PlaceId younger, const Matrix7d& covariance) {
  require(older != younger, "PlacePartition::merge: a place with itself");
  PlaceState& into = places_.at(older);
  const PlaceState& from = places_.at(younger);
  into.last_keyframe = std::max(into.last_keyframe, from.last_keyframe);
  const Sim3 S_older_younger = into.S_map_place.inverse() * from.S_map_place;
  PlaceHistory::Merged merged{from.anchor_keyframe, {}};
  for (auto& [anchor, part] : parts_) {
    if (part.place != younger) continue;
    merged.covariance_of_part[anchor] = part.covariance;
    const Matrix7d adjoint = part.S_place_part.inverse().adjoint();
    part.covariance += adjoint * covariance * adjoint.transpose();
    part.S_place_part = S_older_younger * part.S_place_part;
    part.place = older;
  }
  const KeyframeId first = merged.covariance_of_part.begin()->first;
  merged_.push_back(std::move(merged));
  places_.erase(younger);
  return first;
}

KeyframeId PlacePartition::separate(std::size_t number) {
  const PlaceHistory::Merged merged = merged_.at(number);
  const PlaceId former = parts_.at(merged.anchor).place, again(founded_++);
  const Sim3 S_former_place = parts_.at(merged.anchor).S_place_part;
  PlaceState place = places_.at(former);
  parted_.insert({place.anchor_keyframe, merged.anchor});
  place.anchor_keyframe = merged.anchor;
  place.S_map_place = place.S_map_place * S_former_place;
  place.reach /= S_former_place.scale();
  KeyframeId first = kAfterAll;
  for (const auto& [anchor, covariance] : merged.covariance_of_part) {
    Part& part = parts_.at(anchor);
    if (part.place != former) continue;
    part.place = again;
    part.S_place_part = S_former_place.inverse() * part.S_place_part;
    part.covariance = covariance;
    first = std::min(first, anchor);
  }
  place.last_keyframe = merged.anchor;
  for (const auto& [keyframe, anchor] : part_of_)
    if (parts_.at(anchor).place == again) place.last_keyframe = keyframe;
  places_[again] = place;
  merged_.erase(merged_.begin() + static_cast<std::ptrdiff_t>(number));
  return first;
}

bool PlacePartition::have_parted(PlaceId one, PlaceId other) const {
  return std::any_of(parted_.begin(), parted_.end(), [&](const auto& anchors) {
    return std::minmax(parts_.at(anchors.first).place, parts_.at(anchors.second).place) ==
           std::minmax(one, other);
  });
}

void PlacePartition::set_pose(PlaceId place, const Sim3& S_map_place) {
  places_.at(place).S_map_place = S_map_place;
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
  for (auto& [anchor, part] : parts_) part.S_place_part = Sim3(rigid_part(part.S_place_part));
}

void PlacePartition::rescale(const KeyframeChain& chain, KeyframeId first, double factor) {
  const auto in_run = [&, run = chain.at(first).run](KeyframeId keyframe) {
    return chain.at(keyframe).run == run;
  };
  const int component = state_of(first).component;
  const Eigen::Vector3d centre = S_map_keyframe(chain, first).translation();
  bool alone = true;
  for (const auto& [keyframe, anchor] : part_of_)
    alone &= in_run(keyframe) || state_of(keyframe).component != component;

  for (auto& [anchor, part] : parts_) {
    const Sim3& S = part.S_place_part;
    const double of_place = in_run(places_.at(part.place).anchor_keyframe) ? factor : 1,
                 of_part = in_run(anchor) ? factor : 1;
    part.S_place_part =
        Sim3(S.rotation(), of_place * S.translation(), S.scale() * of_place / of_part);
    if (!in_run(anchor)) continue;
    part.covariance = rescaled_covariance<7>(part.covariance, factor);
    if (part.motion_covariance)
      part.motion_covariance = rescaled_covariance<6>(*part.motion_covariance, factor);
  }
  for (PlaceHistory::Merged& merged : merged_)
    for (auto& [anchor, covariance] : merged.covariance_of_part)
      if (in_run(anchor)) covariance = rescaled_covariance<7>(covariance, factor);
  for (auto& [number, place] : places_) {
    if (!in_run(place.anchor_keyframe)) continue;
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
  return part_of(chain.at(anchor).link->from);
}

SE3 PlacePartition::T_part_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const {
  return chain.T_a_b(part_of(keyframe), keyframe);
}

Sim3 PlacePartition::S_place_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const {
  return parts_.at(part_of(keyframe)).S_place_part * Sim3(T_part_keyframe(chain, keyframe));
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
  // An anchor is older than all that came to its place later.
  for (const auto& [keyframe, anchor] : part_of_) {
    const Sim3 S = S_place_keyframe(chain, keyframe);
    places[index.at(place_of(keyframe))].members.push_back({keyframe, rigid_part(S), S.scale()});
  }
  return places;
}

}  // namespace placegraph
