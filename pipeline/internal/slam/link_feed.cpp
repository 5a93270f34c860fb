#include <placegraph/graph/internal/core/median.h>
#include <placegraph/pipeline/internal/slam/link_feed.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace placegraph {

void LinkFeed::refresh(const LocalMap& map, KeyframeId newest, int keyframes, PlaceMapper& mapper) {
  const KeyframeId oldest(newest.value() - keyframes);
  for (KeyframeId id = std::max(map.first(), oldest), next = id; id < newest; id = next) {
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

  OdometryError error;
  SharedErrors by_shared = SharedErrors::Zero();
  for (KeyframeId id = first; id < last;) {
    const KeyframeId from = id++;
    const auto link = links_.find(id);
    const auto motion = mapper.odometry(from, id);
    if (link == links_.end() || !motion) return std::nullopt;
    const Matrix6d adjoint = motion->T_a_b.inverse().adjoint();
    error.independent = adjoint * error.independent * adjoint.transpose() +
                        map.uncertainty().covariance(link->second.motion);
    by_shared = adjoint * by_shared + map.uncertainty().by_shared_errors(link->second.motion);
  }
  error.shared = by_shared * by_shared.transpose();
  return error;
}

void LinkFeed::finish(const LocalMap& map, PlaceMapper& mapper) {
  for (const auto& [keyframe, link] : links_)
    mapper.inform_link(keyframe, map.information(link.motion), link.sigma_log_scale);
  for (const auto& [anchor, motion] : to_anchors_)
    mapper.inform_anchor(anchor, map.information(motion));
  loops_.finish(mapper);
}

}  // namespace placegraph
