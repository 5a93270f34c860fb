#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Squared error of a constraint between two places over its covariance.
double chi_squared_of(const RelativePoseConstraint& constraint, const Sim3& S_from_to) {
  Eigen::VectorXd error;
  if (const Sim3* measured = std::get_if<Sim3>(&constraint.T_from_to))
    error = (measured->inverse() * S_from_to).log();
  else
    error = (std::get<SE3>(constraint.T_from_to).inverse() *
             SE3(S_from_to.rotation(), S_from_to.translation()))
                .log();
  return error.dot(constraint.information * error);
}

}  // namespace

/// Whether the map is where the loop says: an outlier that the kernel holds off is no witness.
bool PlaceMapper::agrees(const Loop& loop) const {
  constexpr double kChi2 = 24.3;  // 7 degrees of freedom, 99.9 %
  const Sim3 S_match_query = S_map_keyframe(loop.match).inverse() * S_map_keyframe(loop.query);
  const Vector7d error = (loop.S_match_query().inverse() * S_match_query).log();
  return error.dot(loop.information * error) < kChi2;
}

/// Places of the two ends of loops that the map agrees with.
std::vector<std::pair<std::int64_t, std::int64_t>> PlaceMapper::pairs_that_loops_show(
    bool all) const {
  // Old loops have had their chances; they get a last one in the end.
  constexpr std::size_t kRecent = 100;
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for (std::size_t i = all || loops_.size() < kRecent ? 0 : loops_.size() - kRecent;
       i < loops_.size(); ++i) {
    const Loop& loop = loops_[i];
    const std::int64_t a = place_of(loop.match), b = place_of(loop.query);
    if (a != b && agrees(loop)) pairs.emplace_back(a, b);
  }
  return pairs;
}

/// The older place that one stands in by the map, once loops have led back to known ground: the
/// nearest within reach [in the map's unit] that looks the same way, if the way from there to
/// `keyframe` leads out of reach.
std::optional<std::int64_t> PlaceMapper::known_ground(const Sim3& S_map_here, std::int64_t keyframe,
                                                      double reach) const {
  std::optional<std::int64_t> nearest;
  if (loops_.empty()) return nearest;
  const PlaceState& own = place_at(keyframe);
  double least = reach;
  for (const auto& [number, place] : places_) {
    if (place.anchor_keyframe >= own.anchor_keyframe || place.component != own.component) continue;
    const double place_reach = place.reach * place.S_map_place.scale();
    const double distance = (place.S_map_place.translation() - S_map_here.translation()).norm();
    if (distance >= std::min(least, place_reach)) continue;
    const SO3 turn = place.S_map_place.rotation().inverse() * S_map_here.rotation();
    if (turn.log().norm() >= deg_to_rad(options_.max_angle_deg)) continue;
    const auto way = odometry(place.anchor_keyframe, keyframe);
    if (way && way->path_length * own.S_map_place.scale() < 2 * std::max(reach, place_reach))
      continue;
    least = distance;
    nearest = number;
  }
  return nearest;
}

/// Whether a keyframe stands in the same older place as the anchor of its part: where a way is gone
/// again, its parts end where those of the first time did.
bool PlaceMapper::same_known_ground(const Node& node, const Sim3& S_place_this) const {
  const PlaceState& place = place_at(node.part);
  const double reach = place.reach * place.S_map_place.scale();
  return known_ground(place.S_map_place * S_place_this, node.part, reach) ==
         known_ground(S_map_keyframe(node.part), node.part, reach);
}

/// Places that lie in older ones by the map itself.
std::vector<std::pair<std::int64_t, std::int64_t>> PlaceMapper::pairs_on_known_ground(
    bool all) const {
  constexpr std::ptrdiff_t kRecent = 8;
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  const auto count = static_cast<std::ptrdiff_t>(places_.size());
  for (auto at = std::prev(places_.end(), all ? count : std::min(count, kRecent));
       at != places_.end(); ++at) {
    const auto& [number, place] = *at;
    if (const auto older = known_ground(place.S_map_place, place.anchor_keyframe,
                                        place.reach * place.S_map_place.scale()))
      pairs.emplace_back(*older, number);
  }
  return pairs;
}

/// Whether the two hold parts that were merged once by mistake.
bool PlaceMapper::have_parted(std::int64_t one, std::int64_t other) const {
  return std::any_of(parted_.begin(), parted_.end(), [&](const auto& anchors) {
    return std::minmax(parts_.at(anchors.first).place, parts_.at(anchors.second).place) ==
           std::minmax(one, other);
  });
}

/// The merger of two places, if they are within reach of each other, look the same way, are well
/// enough known to each other, and all their keyframes are older than `first_open`.
std::optional<PlaceMapper::Merger> PlaceMapper::merger_of(std::int64_t one, std::int64_t other,
                                                          std::int64_t first_open) const {
  const auto by_age = std::minmax(one, other, [&](std::int64_t p, std::int64_t q) {
    return places_.at(p).anchor_keyframe < places_.at(q).anchor_keyframe;
  });
  const std::int64_t older = by_age.first, younger = by_age.second;
  const PlaceState &a = places_.at(older), &b = places_.at(younger);
  if (b.last_keyframe >= first_open || a.anchor_keyframe >= first_open || have_parted(one, other))
    return std::nullopt;
  const Sim3 S_a_b = a.S_map_place.inverse() * b.S_map_place;
  if (S_a_b.translation().norm() >= a.reach ||
      S_a_b.rotation().log().norm() >= deg_to_rad(options_.max_angle_deg))
    return std::nullopt;
  const Merger merger{older, younger, optimizer_.relative_covariance(older, younger)};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      Eigen::Matrix3d(merger.covariance.topLeftCorner<3, 3>()), Eigen::EigenvaluesOnly);
  if (std::sqrt(eigen.eigenvalues()[2]) > options_.merge_sigma * b.reach) return std::nullopt;
  return merger;
}

/// Merges places that are one; of every place only with the first, as the others change with it.
bool PlaceMapper::merge_all(std::int64_t first_open) {
  if (!options_.merge) return false;
  std::vector<Merger> mergers;
  std::set<std::int64_t> taken;
  const bool all = first_open == kNever;
  for (const auto& pairs : {pairs_that_loops_show(all), pairs_on_known_ground(all)})
    for (const auto& [a, b] : pairs) {
      if (taken.count(a) || taken.count(b)) continue;
      if (const auto merger = merger_of(a, b, first_open)) {
        mergers.push_back(*merger);
        taken.insert({a, b});
      }
    }
  for (const Merger& merger : mergers) merge(merger);
  return !mergers.empty();
}

/// The parts of the younger place become parts of the older one, where the map has them now;
/// constraints follow from the parts.
void PlaceMapper::merge(const Merger& merger) {
  PlaceState& older = places_.at(merger.older);
  const PlaceState& younger = places_.at(merger.younger);
  older.last_keyframe = std::max(older.last_keyframe, younger.last_keyframe);
  const Sim3 S_older_younger = older.S_map_place.inverse() * younger.S_map_place;
  Merged merged{younger.anchor_keyframe, {}};
  for (auto& [anchor, part] : parts_) {
    if (part.place != merger.younger) continue;
    merged.covariance_of_part[anchor] = part.covariance;
    const Matrix7d adjoint = part.S_place_part.inverse().adjoint();
    part.covariance += adjoint * merger.covariance * adjoint.transpose();
    part.S_place_part = S_older_younger * part.S_place_part;
    part.place = merger.older;
    changed(anchor);
  }
  merged_.push_back(std::move(merged));
  places_.erase(merger.younger);
}

/// Which of the mergers the odometry around them contradicts: its edges out of what was merged are
/// further off than chance allows, and so three times over what edges are off elsewhere in the map.
std::vector<bool> PlaceMapper::strained() const {
  constexpr double kStrain = 3, kProbability = 0.999, kMostUsual = 10;
  std::map<std::int64_t, std::vector<std::size_t>> mergers_of_part;
  for (std::size_t i = 0; i < merged_.size(); ++i)
    for (const auto& [anchor, covariance] : merged_[i].covariance_of_part)
      mergers_of_part[anchor].push_back(i);

  std::vector<double> chi2(merged_.size(), 0), ratios;
  std::vector<int> dof(merged_.size(), 0);
  for (const Edge& edge : link_edges(0)) {
    const std::int64_t from = parts_.at(edge.from_part).place, to = parts_.at(edge.to_part).place;
    if (from == to || edge.source != ConstraintSource::kOdometry) continue;
    const RelativePoseConstraint constraint = constraint_of(edge);
    const double error = chi_squared_of(
        constraint, places_.at(from).S_map_place.inverse() * places_.at(to).S_map_place);
    const int directions = static_cast<int>(constraint.information.rows());
    ratios.push_back(error / directions);
    for (const auto& [part, other] :
         {std::pair(edge.from_part, edge.to_part), std::pair(edge.to_part, edge.from_part)}) {
      const auto mergers = mergers_of_part.find(part);
      if (mergers == mergers_of_part.end()) continue;
      for (const std::size_t i : mergers->second) {
        if (merged_[i].covariance_of_part.count(other)) continue;
        chi2[i] += error;
        dof[i] += directions;
      }
    }
  }
  // In a ring that is closed by mistake all edges are strained alike.
  const double usual = ratios.empty() ? 1 : std::clamp(median_of(ratios), 1.0, kMostUsual);
  std::vector<bool> result(merged_.size(), false);
  for (std::size_t i = 0; i < merged_.size(); ++i)
    result[i] = dof[i] > 0 &&
                chi2[i] > kStrain * kStrain * usual * chi_squared_quantile(kProbability, dof[i]);
  return result;
}

/// Undoes mergers for which the evidence has fallen; they are not made again.
bool PlaceMapper::part_strained() {
  judged_loops_ = loops_.size();
  if (merged_.empty()) return false;
  const std::vector<bool> bad = strained();
  // The last first: an earlier one may have brought the place that a later one came to.
  for (std::size_t i = merged_.size(); i-- > 0;) {
    if (!bad[i]) continue;
    separate(merged_[i]);
    merged_.erase(merged_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return std::find(bad.begin(), bad.end(), true) != bad.end();
}

/// What came together goes apart, where it stands in the map.
void PlaceMapper::separate(const Merged& merged) {
  const std::int64_t former = parts_.at(merged.anchor).place, number = founded_++;
  const Sim3 S_former_place = parts_.at(merged.anchor).S_place_part;
  PlaceState place = places_.at(former);
  parted_.insert({place.anchor_keyframe, merged.anchor});
  place.anchor_keyframe = merged.anchor;
  place.S_map_place = place.S_map_place * S_former_place;
  place.reach /= S_former_place.scale();
  for (const auto& [anchor, covariance] : merged.covariance_of_part) {
    Part& part = parts_.at(anchor);
    if (part.place != former) continue;
    part.place = number;
    part.S_place_part = S_former_place.inverse() * part.S_place_part;
    part.covariance = covariance;
    changed(anchor);
  }
  place.last_keyframe = merged.anchor;
  for (const auto& [id, node] : nodes_)
    if (parts_.at(node.part).place == number) place.last_keyframe = id;
  places_[number] = place;
}

}  // namespace placegraph
