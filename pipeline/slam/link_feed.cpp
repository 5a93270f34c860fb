#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/slam/link_feed.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace placegraph {

void LinkFeed::refresh(const LocalMap& map, KeyframeId newest, int keyframes, PlaceMapper& mapper) {
  oldest_refreshed_ = std::max(map.first(), KeyframeId(newest.value() - keyframes));
  for (KeyframeId id = oldest_refreshed_, next = id; id < newest; id = next) {
    ++next;
    mapper.update_link(next, map.pose(id).inverse() * map.pose(next));
    const LocalMap::Link& link = links_[next] = map.link(id);
    mapper.inform_link(next, map.information(link.motion), link.sigma_log_scale);
  }
  const auto begin = map.window_begin();
  if (!begin) return;
  for (KeyframeId id = ++KeyframeId(*begin); id <= newest; ++id) {
    const auto previous = mapper.previous_anchor(id);
    if (!previous || *previous < *begin) continue;
    to_anchors_[id] = map.motion(*previous, id);
    mapper.inform_anchor(id, map.information(to_anchors_[id]));
  }
}

void LinkFeed::rescale(KeyframeId first, double factor) {
  settled_.reset();
  for (auto at = links_.lower_bound(first); at != links_.end(); ++at) {
    at->second.motion = at->second.motion.scaled(factor);
    at->second.sigma_log_scale = 0;
  }
  for (auto at = to_anchors_.lower_bound(first); at != to_anchors_.end(); ++at)
    at->second = at->second.scaled(factor);
}

void LinkFeed::add_loops(const std::vector<Loop>& loops, const LocalMap& map, PlaceMapper& mapper) {
  std::vector<Loop> uncertain;
  for (const Loop& loop : loops) uncertain.push_back(with_errors(loop, map));
  loops_.add(uncertain, mapper);
}

Loop LinkFeed::with_errors(const Loop& loop, const LocalMap& map) const {
  // Motions with a median: the cost. Chosen.
  constexpr std::size_t kNewest = 100;
  std::vector<double> of_position, of_rotation;
  for (auto at = links_.rbegin(); at != links_.rend() && of_position.size() < kNewest; ++at) {
    const AssessedMotion& motion = at->second.motion;
    const Matrix6d stated = motion.stated, covariance = map.uncertainty().covariance(motion);
    of_position.push_back(
        (stated.topLeftCorner<3, 3>().inverse() * covariance.topLeftCorner<3, 3>()).trace() / 3);
    of_rotation.push_back(
        (stated.bottomRightCorner<3, 3>().inverse() * covariance.bottomRightCorner<3, 3>())
            .trace() /
        3);
  }
  Loop result = loop;
  if (links_.empty()) return result;
  const double position = std::sqrt(std::max(1.0, median_of(of_position)));
  const double rotation = std::sqrt(std::max(1.0, median_of(of_rotation)));
  Vector7d scale;
  scale << Eigen::Vector3d::Constant(1 / position), Eigen::Vector3d::Constant(1 / rotation), 1;
  result.information = scale.asDiagonal() * loop.information * scale.asDiagonal();
  return result;
}

std::optional<OdometryError> LinkFeed::odometry_error(const LocalMap& map,
                                                      const PlaceMapper& mapper) const {
  const std::vector<Place> places = mapper.places();
  if (places.empty()) return std::nullopt;
  KeyframeId first = places.front().anchor_keyframe, last = first;
  for (const Place& place : places)
    if (place.component == places.front().component) last = std::max(last, place.anchor_keyframe);
  if (first == last) return std::nullopt;

  ChainErrors errors = errors_from(first);
  if (!extend(errors, last, map, mapper)) return std::nullopt;
  return OdometryError{errors.independent, errors.by_shared * errors.by_shared.transpose()};
}

/// The errors with which a chain begins: none, or those of the run that was interrupted. Its last
/// keyframe and the first one of this run are of the same image.
ChainErrors LinkFeed::errors_from(KeyframeId first) const {
  if (!earlier_ || earlier_->first != first) return {first, first};
  ChainErrors errors = *earlier_;
  ++errors.last;
  return errors;
}

/// Goes on along the links to keyframe `last`; returns whether there are links all the way.
bool LinkFeed::extend(ChainErrors& errors, KeyframeId last, const LocalMap& map,
                      const PlaceMapper& mapper) const {
  while (errors.last < last) {
    const KeyframeId from = errors.last, to(from.value() + 1);
    const auto link = links_.find(to);
    const auto motion = mapper.odometry(from, to);
    if (link == links_.end() || !motion) return false;
    const Matrix6d adjoint = motion->T_a_b.inverse().adjoint();
    errors.independent = adjoint * errors.independent * adjoint.transpose() +
                         map.uncertainty().covariance(link->second.motion);
    errors.by_shared =
        adjoint * errors.by_shared + map.uncertainty().by_shared_errors(link->second.motion);
    errors.last = to;
  }
  return true;
}

void LinkFeed::note_errors(KeyframeId first, const LocalMap& map, const PlaceMapper& mapper) {
  noted_.reset();
  if (!settled_ || settled_->first != first) settled_ = errors_from(first);
  if (!extend(*settled_, oldest_refreshed_, map, mapper)) return;
  ChainErrors errors = *settled_;
  if (extend(errors, map.newest(), map, mapper)) noted_ = errors;
}

void LinkFeed::finish(const LocalMap& map, PlaceMapper& mapper) {
  for (const auto& [keyframe, link] : links_)
    mapper.inform_link(keyframe, map.information(link.motion), link.sigma_log_scale);
  for (const auto& [anchor, motion] : to_anchors_)
    mapper.inform_anchor(anchor, map.information(motion));
  loops_.finish(mapper);
}

}  // namespace placegraph
