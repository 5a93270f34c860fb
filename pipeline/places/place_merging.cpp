#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/places/place_constraints.h>
#include <placegraph/pipeline/places/place_merging.h>
#include <placegraph/pipeline/places/place_reach.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

namespace placegraph {
namespace {

using PlacePair = std::pair<PlaceId, PlaceId>;

/// Whether the map agrees with the loop: a loop that the robust kernel rejects is no evidence.
bool agrees(const Loop& loop, const KeyframeChain& chain, const PlacePartition& partition) {
  static const double chi2 = chi_squared_quantile(0.999, 7);
  const Sim3 S_match_query = partition.S_map_keyframe(chain, loop.match).inverse() *
                             partition.S_map_keyframe(chain, loop.query);
  const Vector7d error = (loop.S_match_query().inverse() * S_match_query).log();
  return error.dot(loop.information * error) < chi2;
}

/// Places at the two ends of loops that agree with the map: of all loops, or of the newest.
std::vector<PlacePair> pairs_of_loops(const KeyframeChain& chain, const PlacePartition& partition,
                                      const std::vector<Loop>& loops, bool all) {
  // Loops that are looked at after each place: the cost. Chosen.
  constexpr std::size_t kNewest = 100;
  std::vector<PlacePair> pairs;
  for (std::size_t i = all || loops.size() < kNewest ? 0 : loops.size() - kNewest; i < loops.size();
       ++i) {
    const PlaceId a = partition.place_of(loops[i].match), b = partition.place_of(loops[i].query);
    if (a != b && agrees(loops[i], chain, partition)) pairs.emplace_back(a, b);
  }
  return pairs;
}

/// Places whose positions in the map are within earlier places: all places, or the newest.
std::vector<PlacePair> pairs_in_reach(const KeyframeChain& chain, const PlacePartition& partition,
                                      const PlaceOptions& options, bool all) {
  // Places that are looked at after each place: the cost. Chosen.
  constexpr std::ptrdiff_t kNewest = 8;
  const auto& places = partition.places();
  const auto count = static_cast<std::ptrdiff_t>(places.size());
  std::vector<PlacePair> pairs;
  for (auto at = std::prev(places.end(), all ? count : std::min(count, kNewest));
       at != places.end(); ++at) {
    const auto& [number, place] = *at;
    if (const auto earlier =
            earlier_place_in_reach(chain, partition, options, place.anchor_keyframe,
                                   place.S_map_place, place.reach * place.S_map_place.scale()))
      pairs.emplace_back(*earlier, number);
  }
  return pairs;
}

std::optional<PlaceMerger> merger_of(const PlacePair& pair, const PlacePartition& partition,
                                     const PlaceOptions& options, const PlaceCovariance& covariance,
                                     KeyframeId first_open) {
  const auto [older, younger] = std::minmax(pair.first, pair.second, [&](PlaceId p, PlaceId q) {
    return partition.places().at(p).anchor_keyframe < partition.places().at(q).anchor_keyframe;
  });
  const PlacePartition::PlaceState &a = partition.places().at(older),
                                   &b = partition.places().at(younger);
  if (b.last_keyframe >= first_open || a.anchor_keyframe >= first_open ||
      partition.were_separated(older, younger))
    return std::nullopt;
  const Sim3 S_a_b = a.S_map_place.inverse() * b.S_map_place;
  if (S_a_b.translation().norm() >= a.reach ||
      S_a_b.rotation().log().norm() >= deg_to_rad(options.max_angle_deg))
    return std::nullopt;
  const PlaceMerger merger{older, younger, covariance(older, younger)};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      Eigen::Matrix3d(merger.covariance.topLeftCorner<3, 3>()), Eigen::EigenvaluesOnly);
  if (std::sqrt(eigen.eigenvalues()[2]) > options.merge_sigma * b.reach) return std::nullopt;
  return merger;
}

/// Squared error of a constraint between two places, normalized by its covariance.
double chi_squared_of(const RelativePoseConstraint& constraint, const Sim3& S_from_to) {
  Eigen::VectorXd error;
  if (const Sim3* measured = std::get_if<Sim3>(&constraint.T_from_to))
    error = (measured->inverse() * S_from_to).log();
  else
    error = (std::get<SE3>(constraint.T_from_to).inverse() * rigid_part(S_from_to)).log();
  return error.dot(constraint.information * error);
}

/// The sum of the squared errors of the odometry edges out of each merger.
struct MergerErrors {
  std::vector<double> chi2;
  std::vector<int> degrees_of_freedom;
  std::vector<double> ratios;  // squared error of every edge over its degrees of freedom
};

MergerErrors errors_of_mergers(const KeyframeChain& chain, const PlacePartition& partition) {
  const std::vector<PlaceHistory::Merged>& merged = partition.merged();
  std::map<KeyframeId, std::vector<std::size_t>> mergers_of_segment;
  for (std::size_t i = 0; i < merged.size(); ++i)
    for (const auto& [anchor, covariance] : merged[i].covariance_of_segment)
      mergers_of_segment[anchor].push_back(i);

  MergerErrors result{
      std::vector<double>(merged.size(), 0), std::vector<int>(merged.size(), 0), {}};
  const bool all_scales_known = chain.all_scales_known();
  for (const PlaceEdge& edge : link_edges(chain, partition, kBeforeAll)) {
    const PlaceId from = partition.segments().at(edge.from_segment).place,
                  to = partition.segments().at(edge.to_segment).place;
    if (from == to || edge.source != ConstraintSource::kOdometry) continue;
    const RelativePoseConstraint constraint =
        constraint_between_places(partition, edge, all_scales_known);
    const double error =
        chi_squared_of(constraint, partition.places().at(from).S_map_place.inverse() *
                                       partition.places().at(to).S_map_place);
    const int directions = static_cast<int>(constraint.information.rows());
    result.ratios.push_back(error / directions);
    for (const auto& [segment, other] : {std::pair(edge.from_segment, edge.to_segment),
                                         std::pair(edge.to_segment, edge.from_segment)}) {
      const auto mergers = mergers_of_segment.find(segment);
      if (mergers == mergers_of_segment.end()) continue;
      for (const std::size_t i : mergers->second) {
        if (merged[i].covariance_of_segment.count(other)) continue;
        result.chi2[i] += error;
        result.degrees_of_freedom[i] += directions;
      }
    }
  }
  return result;
}

}  // namespace

std::vector<PlaceMerger> find_mergers(const KeyframeChain& chain, const PlacePartition& partition,
                                      const std::vector<Loop>& loops, const PlaceOptions& options,
                                      const PlaceCovariance& covariance, KeyframeId first_open) {
  std::vector<PlaceMerger> mergers;
  std::set<PlaceId> taken;
  // Older loops were examined before; they are examined again at the end.
  const bool all = first_open == kNoneOpen;
  std::vector<PlacePair> pairs = pairs_of_loops(chain, partition, loops, all);
  // Once loops have led back to known places, the map itself shows where places meet.
  if (!loops.empty()) {
    const std::vector<PlacePair> others = pairs_in_reach(chain, partition, options, all);
    pairs.insert(pairs.end(), others.begin(), others.end());
  }
  for (const PlacePair& pair : pairs) {
    if (taken.count(pair.first) || taken.count(pair.second)) continue;
    if (const auto merger = merger_of(pair, partition, options, covariance, first_open)) {
      mergers.push_back(*merger);
      taken.insert({pair.first, pair.second});
    }
  }
  return mergers;
}

std::vector<std::size_t> contradicted_mergers(const KeyframeChain& chain,
                                              const PlacePartition& partition) {
  // Chosen: three times the usual ratio of errors, which is ten at most, and 99.9 % of chi squared.
  constexpr double kTimesUsual = 3, kProbability = 0.999, kMostUsual = 10;
  std::vector<std::size_t> result;
  if (partition.merged().empty()) return result;
  const MergerErrors errors = errors_of_mergers(chain, partition);
  // In a ring that is closed by mistake, the strain is the same for all edges.
  const double usual =
      errors.ratios.empty() ? 1 : std::clamp(median_of(errors.ratios), 1.0, kMostUsual);
  for (std::size_t i = 0; i < errors.chi2.size(); ++i) {
    const int dof = errors.degrees_of_freedom[i];
    if (dof > 0 && errors.chi2[i] >
                       kTimesUsual * kTimesUsual * usual * chi_squared_quantile(kProbability, dof))
      result.push_back(i);
  }
  return result;
}

}  // namespace placegraph
