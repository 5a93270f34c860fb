#include <placegraph/pipeline/place_mapper.h>

#include <Eigen/Eigenvalues>
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
  merge_all(first_open);
  settle_units();
  return step;
}

IncrementalStep PlaceMapper::finish() {
  (void)follow();
  (void)optimizer_.finish();
  take_poses();
  merge_all(kNever);
  (void)follow();
  const IncrementalStep step = optimizer_.finish();
  take_poses();
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
  motion.way = shortest_way(a, b) / S_map_keyframe(to).scale();
  const Matrix7d adjoint = S_place_keyframe(nodes_.at(to)).inverse().adjoint();
  motion.covariance = adjoint * optimizer_.relative_covariance(a, b) * adjoint.transpose();
  return motion;
}

/// Whether the map is where the loop says: an outlier that the kernel holds off is no witness.
bool PlaceMapper::agrees(const Loop& loop) const {
  constexpr double kChi2 = 24.3;  // 7 degrees of freedom, 99.9 %
  const Sim3 S_match_query = S_map_keyframe(loop.match).inverse() * S_map_keyframe(loop.query);
  const Vector7d error = (loop.S_match_query().inverse() * S_match_query).log();
  return error.dot(loop.information * error) < kChi2;
}

/// Pairs of places within reach of each other by a loop that the map agrees with, and well enough
/// known to each other; of every place only the first, as the others change with it.
std::vector<PlaceMapper::Merger> PlaceMapper::find_mergers(std::int64_t first_open) const {
  // Old loops have had their chances; they get a last one in the end.
  constexpr std::size_t kRecent = 100;
  const std::size_t begin =
      first_open == kNever || loops_.size() < kRecent ? 0 : loops_.size() - kRecent;
  std::vector<Merger> mergers;
  std::set<std::int64_t> taken;
  for (std::size_t i = begin; i < loops_.size(); ++i) {
    const Loop& loop = loops_[i];
    const std::int64_t older = std::min(place_of(loop.match), place_of(loop.query));
    const std::int64_t younger = std::max(place_of(loop.match), place_of(loop.query));
    if (older == younger || taken.count(older) || taken.count(younger)) continue;
    const PlaceState &a = places_.at(older), &b = places_.at(younger);
    if (b.last_keyframe >= first_open || a.anchor_keyframe >= first_open) continue;
    const Sim3 S_a_b = a.S_map_place.inverse() * b.S_map_place;
    if (S_a_b.translation().norm() >= a.reach ||
        S_a_b.rotation().log().norm() >= options_.max_angle_deg * M_PI / 180 || !agrees(loop))
      continue;
    const Merger merger{older, younger, optimizer_.relative_covariance(older, younger)};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
        Eigen::Matrix3d(merger.covariance.topLeftCorner<3, 3>()), Eigen::EigenvaluesOnly);
    if (std::sqrt(eigen.eigenvalues()[2]) > options_.merge_sigma * b.reach) continue;
    mergers.push_back(merger);
    taken.insert({older, younger});
  }
  return mergers;
}

void PlaceMapper::merge_all(std::int64_t first_open) {
  if (!options_.merge) return;
  for (const Merger& merger : find_mergers(first_open)) merge(merger);
}

/// The parts of the younger place become parts of the older one, where the map has them now;
/// constraints follow from the parts.
void PlaceMapper::merge(const Merger& merger) {
  PlaceState& older = places_.at(merger.older);
  older.last_keyframe = std::max(older.last_keyframe, places_.at(merger.younger).last_keyframe);
  const Sim3 S_older_younger = older.S_map_place.inverse() * places_.at(merger.younger).S_map_place;
  for (auto& [anchor, part] : parts_) {
    if (part.place != merger.younger) continue;
    const Matrix7d adjoint = part.S_place_part.inverse().adjoint();
    part.covariance += adjoint * merger.covariance * adjoint.transpose();
    part.S_place_part = S_older_younger * part.S_place_part;
    part.place = merger.older;
    changed(anchor);
  }
  places_.erase(merger.younger);
}

}  // namespace placegraph
