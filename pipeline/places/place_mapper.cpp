#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/geometry/bounded_covariance.h>
#include <placegraph/pipeline/places/place_components.h>
#include <placegraph/pipeline/places/place_constraints.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/places/place_merging.h>
#include <placegraph/pipeline/places/place_reach.h>
#include <placegraph/pipeline/places/rescaling.h>
#include <placegraph/pipeline/places/shortest_path.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

PlaceMapper::PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer)
    : options_(options), optimizer_(optimizer) {
  options_.check();
}

PlaceMapper::PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer,
                         const std::vector<Place>& places, const PlaceHistory& history)
    : PlaceMapper(options, optimizer) {
  partition_ = PlacePartition(places, history);
  chain_ = KeyframeChain(history.keyframes, history.scale_measured);
  for (const PlaceHistory::Motion& motion : history.motions)
    add_motion(motion.from, motion.to, motion.T_from_to, motion.covariance);
  for (const Loop& loop : history.loops)
    require(chain_.contains(loop.match) && chain_.contains(loop.query),
            "PlaceMapper: a loop between unknown keyframes");
  loops_ = history.loops;
  judged_loops_ = history.judged_loops;
}

PlaceHistory PlaceMapper::history() const {
  PlaceHistory history;
  for (const auto& [id, keyframe] : chain_.keyframes())
    history.keyframes.push_back(
        {id, partition_.segment_of(id), keyframe.track_segment, keyframe.link});
  partition_.save(history);
  history.motions = motions_;
  history.loops = loops_;
  history.judged_loops = judged_loops_;
  history.scale_measured = chain_.scale_known();
  return history;
}

void PlaceMapper::changed(KeyframeId keyframe) {
  unoptimized_from_ = std::min(unoptimized_from_, keyframe);
  unpublished_from_ = std::min(unpublished_from_, keyframe);
}

void PlaceMapper::add_keyframe(KeyframeId id, const std::optional<Link>& link,
                               const SE3& T_map_guess, double median_depth_m, bool scale_known) {
  const bool were_known = chain_.all_scales_known();
  chain_.add(id, link, scale_known);
  changed(id);
  // The graph is now over Sim(3).
  if (chain_.all_scales_known() != were_known) unpublished_from_ = kBeforeAll;
  if (chain_.has_odometry(id) &&
      in_reach_of_segment(chain_, partition_, loops_, options_, id, median_depth_m)) {
    partition_.join(id, partition_.segment_of(link->from));
    return;
  }
  Sim3 S_map_place(T_map_guess);
  int component = 0;
  if (link) {
    S_map_place = S_map_keyframe(link->from) *
                  Sim3(link->T_from_this.rotation(), link->T_from_this.translation(), link->scale);
    component = component_of(link->from);
  } else {
    for (const auto& [number, place] : partition_.places())
      component = std::max(component, place.component + 1);
  }
  partition_.found(id, S_map_place, component, options_.max_distance * median_depth_m);
}

void PlaceMapper::update_link(KeyframeId id, const SE3& T_from_this) {
  // The newest part of the track has moved, so that an anchor follows its predecessor, unless its
  // place is an older one into which it was merged.
  chain_.update_link(id, T_from_this);
  changed(id);
  if (partition_.state_of(id).anchor_keyframe == id)
    partition_.set_pose(place_of(id), S_map_keyframe(chain_.at(id).link->from) * Sim3(T_from_this));
}

void PlaceMapper::correct_links(const std::map<KeyframeId, Vector6d>& corrections) {
  if (corrections.empty()) return;
  chain_.correct_links(corrections);
  changed(corrections.begin()->first);
}

void PlaceMapper::inform_link(KeyframeId id, const Matrix6d& information, double sigma_log_scale) {
  chain_.inform_link(id, information, sigma_log_scale);
  changed(id);
}

std::optional<KeyframeId> PlaceMapper::previous_anchor(KeyframeId anchor) const {
  return partition_.previous_anchor(chain_, anchor);
}

void PlaceMapper::inform_anchor(KeyframeId anchor, const Matrix6d& information) {
  require(previous_anchor(anchor).has_value(),
          "PlaceMapper::inform_anchor: no anchor, or the first of its track segment");
  partition_.set_motion_covariance(anchor, bounded_covariance(information));
  changed(anchor);
}

void PlaceMapper::add_motion(KeyframeId previous, KeyframeId anchor, const SE3& T_previous_anchor,
                             const Matrix6d& covariance) {
  require(is_anchor(previous) && is_anchor(anchor) && previous != anchor,
          "PlaceMapper::add_motion: two anchors needed");
  motions_.push_back({previous, anchor, T_previous_anchor, covariance});
  changed(anchor);
}

std::size_t PlaceMapper::add_loop(const Loop& loop) {
  loops_.push_back(loop);
  changed(std::max(loop.match, loop.query));
  return loops_.size() - 1;
}

void PlaceMapper::scale_loop_covariance(std::size_t number, double factor) {
  require(number < loops_.size(), "PlaceMapper::scale_loop_covariance: an unknown loop");
  Loop& loop = loops_[number];
  Vector7d scale = Vector7d::Constant(1 / std::sqrt(factor));
  scale[6] = 1;
  loop.information = scale.asDiagonal() * loop.information * scale.asDiagonal();
  changed(std::max(loop.match, loop.query));
}

void PlaceMapper::reconsider() {
  for (std::size_t number = partition_.merged().size(); number > 0; --number)
    changed(partition_.separate(number - 1, false));
  split_components(chain_, loops_, partition_);
  optimizer_.reset();
  unpublished_from_ = kBeforeAll;
}

void PlaceMapper::rescale(KeyframeId first, double factor) {
  partition_.rescale(chain_, first, factor);
  chain_.rescale(first, factor);
  const int track_segment = chain_.at(first).track_segment;
  for (Loop& loop : loops_)
    loop = rescaled_loop(loop, chain_.at(loop.match).track_segment == track_segment,
                         chain_.at(loop.query).track_segment == track_segment, factor);
  optimizer_.reset();  // its lengths have another scale
  unpublished_from_ = kBeforeAll;
}

std::vector<PlaceConstraint> PlaceMapper::constraints(KeyframeId since) const {
  return place_constraints(chain_, partition_, loops_, motions_, options_, since);
}

/// Passes the changes to the optimizer.
IncrementalStep PlaceMapper::update_optimizer() {
  const PoseKind kind = chain_.all_scales_known() ? PoseKind::kSE3 : PoseKind::kSim3;
  if (kind == PoseKind::kSE3) partition_.drop_scales();
  join_components(chain_, loops_, partition_);
  const bool begin = optimizer_.kind() != kind;
  std::vector<PoseNode> nodes;
  for (const auto& [number, place] : partition_.places()) {
    if (!begin && optimizer_.knows(number)) continue;
    const Sim3& S = place.S_map_place;
    nodes.push_back(
        {node_of_place(number), kind == PoseKind::kSim3 ? Pose(S) : Pose(rigid_part(S)), false});
  }
  const IncrementalStep step = begin ? optimizer_.begin(nodes, constraints(kBeforeAll))
                                     : optimizer_.follow(nodes, constraints(unoptimized_from_));
  unoptimized_from_ = kAfterAll;
  return step;
}

void PlaceMapper::take_poses() {
  for (const auto& [number, place] : partition_.places())
    partition_.set_pose(number, optimizer_.S_map_place(number));
}

/// Merges places that are the same; returns whether there were any.
bool PlaceMapper::merge(KeyframeId first_open) {
  if (!options_.merge) return false;
  const auto covariance = [&](PlaceId from, PlaceId to) {
    return optimizer_.relative_covariance(from, to);
  };
  const auto mergers = find_mergers(chain_, partition_, loops_, options_, covariance, first_open);
  for (const PlaceMerger& merger : mergers)
    changed(partition_.merge(merger.older, merger.younger, merger.covariance));
  return !mergers.empty();
}

/// Undoes mergers that odometry contradicts and excludes them in the future. Returns whether there
/// were any.
bool PlaceMapper::separate_contradicted() {
  judged_loops_ = loops_.size();
  std::vector<std::size_t> contradicted = contradicted_mergers(chain_, partition_);
  // The last first: an earlier merger may have created the place into which a later one merged.
  std::reverse(contradicted.begin(), contradicted.end());
  for (const std::size_t number : contradicted) changed(partition_.separate(number));
  return !contradicted.empty();
}

IncrementalStep PlaceMapper::optimize(KeyframeId first_open) {
  const IncrementalStep step = update_optimizer();
  take_poses();
  if (judged_loops_ == loops_.size() || !separate_contradicted()) merge(first_open);
  normalize_scales(chain_, partition_);
  return step;
}

IncrementalStep PlaceMapper::finish() {
  const auto settle = [&] {
    (void)update_optimizer();
    const IncrementalStep step = optimizer_.finish();
    take_poses();
    return step;
  };
  IncrementalStep step = settle();
  // A place joins one other at a time, and every merger changes the map a little.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    check_interruption();
    const bool separated = separate_contradicted();
    if (separated) step = settle();
    const bool merged = merge(kNoneOpen);
    if (merged) step = settle();
    if (!separated && !merged) break;
  }
  normalize_scales(chain_, partition_);
  return step;
}

bool PlaceMapper::scale_unknown(KeyframeId a, KeyframeId b) const {
  return !chain_.scale_known(a) || !chain_.scale_known(b);
}

bool PlaceMapper::metric() const {
  return std::any_of(chain_.keyframes().begin(), chain_.keyframes().end(), [&](const auto& entry) {
    return chain_.scale_known(entry.first) && component_of(entry.first) == 0;
  });
}

std::optional<TrackedMotion> PlaceMapper::odometry(KeyframeId from, KeyframeId to) const {
  return chain_.odometry(from, to);
}

std::optional<PredictedMotion> PlaceMapper::predicted(KeyframeId from, KeyframeId to) const {
  const PlaceId a = place_of(from), b = place_of(to);
  if (component_of(from) != component_of(to) || !optimizer_.knows(a) || !optimizer_.knows(b))
    return std::nullopt;
  const Sim3 S_map_to = S_map_keyframe(to);
  PredictedMotion motion{S_map_keyframe(from).inverse() * S_map_to};
  if (a == b) return motion;
  motion.path_length = shortest_path(chain_, partition_, loops_, a, b) / S_map_to.scale();
  const Matrix7d adjoint = partition_.S_place_keyframe(chain_, to).inverse().adjoint();
  motion.covariance = adjoint * optimizer_.relative_covariance(a, b) * adjoint.transpose();
  return motion;
}

std::vector<Place> PlaceMapper::places() const { return partition_.graph_places(chain_); }

PlaceGraph PlaceMapper::place_graph() const {
  PlaceGraph graph;
  graph.places = places();
  for (const PlaceConstraint& constraint : constraints(kBeforeAll))
    if (constraint.measured) graph.constraints.push_back(*constraint.measured);
  return graph;
}

std::vector<MapChanges::ConstraintChange> PlaceMapper::take_constraint_changes() {
  std::vector<MapChanges::ConstraintChange> changes;
  for (const PlaceConstraint& constraint : constraints(unpublished_from_))
    changes.push_back(
        {static_cast<int>(constraint.key.first), constraint.key.second, constraint.measured});
  unpublished_from_ = kAfterAll;
  return changes;
}

}  // namespace placegraph
