#include <placegraph/pipeline/places/place_mapper.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <set>

namespace placegraph {

/// Components that a loop connects become one: the younger moves onto the older, in its unit.
void PlaceMapper::bring_together() {
  for (const Loop& loop : loops_) {
    const int a = component_of(loop.match), b = component_of(loop.query);
    if (a == b) continue;
    const bool query_moves = b > a;
    const Sim3 S_map_new = query_moves
                               ? S_map_keyframe(loop.match) * loop.S_match_query()
                               : S_map_keyframe(loop.query) * loop.S_match_query().inverse();
    const Sim3 S_map_old = S_map_keyframe(query_moves ? loop.query : loop.match);
    const Sim3 S_new_old = S_map_new * S_map_old.inverse();
    const int moving = std::max(a, b), staying = std::min(a, b);
    for (auto& [number, place] : places_)
      if (place.component == moving) {
        place.S_map_place = S_new_old * place.S_map_place;
        place.component = staying;
      }
  }
}

/// A component whose unit is measured somewhere is given in that unit; its first place stays where
/// it is. Where all units are measured, nothing has a scale of its own.
void PlaceMapper::settle_units() {
  if (!free_units()) {
    const auto unscaled = [](const Sim3& S) { return Sim3(S.rotation(), S.translation(), 1); };
    for (auto& [number, place] : places_) place.S_map_place = unscaled(place.S_map_place);
    for (auto& [anchor, part] : parts_) part.S_place_part = unscaled(part.S_place_part);
    return;
  }
  struct Unit {
    Eigen::Vector3d centre;
    double log_scales = 0;
    int measured = 0;
    bool first_measured = false;
  };
  std::map<int, Unit> units;
  for (const auto& [number, place] : places_) {
    const bool known = scale_known_[nodes_.at(place.anchor_keyframe).run];
    const auto [unit, first] =
        units.try_emplace(place.component, Unit{place.S_map_place.translation()});
    if (first) unit->second.first_measured = known;
    // The first place, which is held, tells it alone if it is measured.
    if (!known || (!first && unit->second.first_measured)) continue;
    unit->second.log_scales += std::log(place.S_map_place.scale());
    ++unit->second.measured;
  }
  for (auto& [number, place] : places_) {
    const Unit& unit = units.at(place.component);
    if (unit.measured == 0) continue;
    const double factor = std::exp(-unit.log_scales / unit.measured);
    const Sim3& S = place.S_map_place;
    place.S_map_place = Sim3(S.rotation(), unit.centre + factor * (S.translation() - unit.centre),
                             factor * S.scale());
  }
}

void PlaceMapper::take_poses() {
  for (auto& [number, place] : places_) place.S_map_place = optimizer_.S_map_place(number);
}

/// Hands the optimizer what has changed.
IncrementalStep PlaceMapper::follow() {
  const PoseKind kind = free_units() ? PoseKind::kSim3 : PoseKind::kSE3;
  if (!free_units()) settle_units();
  bring_together();
  begin_anew_ |= optimizer_.kind() != kind;
  std::vector<PoseNode> fresh;
  for (const auto& [number, place] : places_) {
    if (!begin_anew_ && optimizer_.knows(number)) continue;
    const Sim3& S = place.S_map_place;
    const SE3 T_map_place(S.rotation(), S.translation());
    fresh.push_back({number, kind == PoseKind::kSim3 ? Pose(S) : Pose(T_map_place), false});
  }
  const IncrementalStep step = begin_anew_ ? optimizer_.begin(fresh, constraints(0))
                                           : optimizer_.follow(fresh, constraints(changed_since_));
  begin_anew_ = false;
  changed_since_ = kNever;
  return step;
}

IncrementalStep PlaceMapper::optimize(std::int64_t first_open) {
  const IncrementalStep step = follow();
  take_poses();
  if (judged_loops_ == loops_.size() || !part_strained()) merge_all(first_open);
  settle_units();
  return step;
}

IncrementalStep PlaceMapper::finish() {
  const auto settle = [&] {
    (void)follow();
    const IncrementalStep step = optimizer_.finish();
    take_poses();
    return step;
  };
  IncrementalStep step = settle();
  // A place joins one other at a time, and every one changes the map a little.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const bool parted = part_strained();
    if (parted) step = settle();
    const bool merged = merge_all(kNever);
    if (merged) step = settle();
    if (!parted && !merged) break;
  }
  settle_units();
  return step;
}

/// From place to place along links and loops, in the map's unit; infinite if they do not lead
/// there.
double PlaceMapper::shortest_way(std::int64_t from, std::int64_t to) const {
  std::map<std::int64_t, std::vector<std::int64_t>> neighbours;
  const auto join = [&](std::int64_t a, std::int64_t b) {
    if (a == b) return;
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  };
  for (const auto& [anchor, part] : parts_)
    if (const auto& link = nodes_.at(anchor).link) join(part.place, place_of(link->from));
  for (const Loop& loop : loops_) join(place_of(loop.match), place_of(loop.query));

  using Reached = std::pair<double, std::int64_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::set<std::int64_t> done;
  open.emplace(0, from);
  while (!open.empty()) {
    const auto [way, place] = open.top();
    open.pop();
    if (place == to) return way;
    if (!done.insert(place).second) continue;
    const Eigen::Vector3d& here = places_.at(place).S_map_place.translation();
    for (const std::int64_t next : neighbours[place])
      open.emplace(way + (places_.at(next).S_map_place.translation() - here).norm(), next);
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<PredictedMotion> PlaceMapper::predicted(std::int64_t from, std::int64_t to) const {
  const std::int64_t a = place_of(from), b = place_of(to);
  if (component_of(from) != component_of(to) || begin_anew_ || !optimizer_.knows(a) ||
      !optimizer_.knows(b))
    return std::nullopt;
  PredictedMotion motion{S_map_keyframe(from).inverse() * S_map_keyframe(to)};
  if (a == b) return motion;
  motion.path_length = shortest_way(a, b) / S_map_keyframe(to).scale();
  const Matrix7d adjoint = S_place_keyframe(nodes_.at(to)).inverse().adjoint();
  motion.covariance = adjoint * optimizer_.relative_covariance(a, b) * adjoint.transpose();
  return motion;
}

}  // namespace placegraph
