#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_mapper.h>

namespace placegraph {

PlaceHistory PlaceMapper::history() const {
  PlaceHistory history;
  for (const auto& [id, node] : nodes_)
    history.keyframes.push_back({id, node.part, node.run, node.link});
  for (const auto& [anchor, part] : parts_)
    history.parts.push_back(
        {anchor, part.place, part.S_place_part, part.covariance, part.motion_covariance});
  for (const auto& [number, place] : places_)
    history.places.push_back({number, place.reach, place.last_keyframe});
  for (const Edge& motion : motions_)
    history.motions.push_back({motion.from_part, motion.to_part,
                               SE3(motion.S_from_to.rotation(), motion.S_from_to.translation()),
                               motion.covariance.topLeftCorner<6, 6>()});
  history.loops = loops_;
  history.merged = merged_;
  history.parted = parted_;
  history.founded = founded_;
  history.judged_loops = judged_loops_;
  history.unit_measured = scale_known_;
  return history;
}

PlaceMapper::PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer,
                         const std::vector<Place>& places, const PlaceHistory& history)
    : PlaceMapper(options, optimizer) {
  require(places.size() == history.places.size(),
          "PlaceMapper: places and their history differ in number");
  scale_known_ = history.unit_measured;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    require(place.id == history.places[i].id, "PlaceMapper: history of another place");
    places_[place.id] = {place.anchor_keyframe, place.S_map_place(), place.component,
                         history.places[i].reach, history.places[i].last_keyframe};
  }
  for (const PlaceHistory::Part& part : history.parts) {
    require(places_.count(part.place) == 1, "PlaceMapper: a part of an unknown place");
    parts_[part.anchor] = {part.place, part.S_place_part, part.covariance, part.motion_covariance};
  }
  for (const PlaceHistory::Keyframe& keyframe : history.keyframes) {
    const auto& link = keyframe.link;
    require(parts_.count(keyframe.part) == 1 && (!link || nodes_.count(link->from) == 1) &&
                keyframe.run >= 0 && keyframe.run < static_cast<int>(scale_known_.size()),
            "PlaceMapper: keyframe " + std::to_string(keyframe.id) +
                " has no part, or is linked to none");
    nodes_[keyframe.id] = {
        keyframe.part, link,         link ? covariance_of(*link) : Matrix7d(Matrix7d::Zero()),
        SE3(),         keyframe.run, 0};
  }
  for (const auto& [anchor, part] : parts_)
    require(nodes_.count(anchor) == 1 && nodes_.at(anchor).part == anchor,
            "PlaceMapper: a part without its anchor");
  for (const PlaceHistory::Motion& motion : history.motions)
    add_motion(motion.from, motion.to, motion.T_from_to, motion.covariance);
  for (const Loop& loop : history.loops) {
    require(nodes_.count(loop.match) == 1 && nodes_.count(loop.query) == 1,
            "PlaceMapper: a loop between unknown keyframes");
    loops_.push_back(loop);
  }
  for (const PlaceHistory::Merged& merged : history.merged) {
    bool known = parts_.count(merged.anchor) == 1;
    for (const auto& [anchor, covariance] : merged.covariance_of_part)
      known &= parts_.count(anchor) == 1;
    require(known, "PlaceMapper: an unknown part was merged");
    merged_.push_back(merged);
  }
  parted_ = history.parted;
  founded_ = history.founded;
  judged_loops_ = history.judged_loops;
  require(places_.empty() || founded_ > places_.rbegin()->first,
          "PlaceMapper: fewer places were founded than there are");
  follow_links(kFirst);
  begin_anew_ = true;
}

std::vector<MapChanges::ConstraintChange> PlaceMapper::take_constraint_changes() {
  if (told_free_units_ != free_units()) untold_since_ = kFirst;
  told_free_units_ = free_units();
  std::vector<MapChanges::ConstraintChange> changes;
  for (const PlaceConstraint& constraint : constraints(untold_since_))
    changes.push_back(
        {static_cast<int>(constraint.key.first), constraint.key.second, constraint.measured});
  untold_since_ = kNever;
  return changes;
}

}  // namespace placegraph
