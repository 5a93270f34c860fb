#include <placegraph/backend/pose_marginals.h>
#include <placegraph/pipeline/place_mapper.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
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
    if (!known) continue;
    unit->second.log_scales += std::log(place.S_map_place.scale());
    ++unit->second.measured;
  }
  for (auto& [number, place] : places_) {
    const Unit& unit = units.at(place.component);
    if (unit.measured == 0 || unit.first_measured) continue;
    const double factor = std::exp(-unit.log_scales / unit.measured);
    const Sim3& S = place.S_map_place;
    place.S_map_place = Sim3(S.rotation(), unit.centre + factor * (S.translation() - unit.centre),
                             factor * S.scale());
  }
}

void PlaceMapper::take_poses(const PlaceGraph& optimized) {
  for (const Place& place : optimized.places)
    places_.at(place.id).S_map_place = place.S_map_place();
}

PoseGraphReport PlaceMapper::optimize(const PoseGraphOptions& options, const LogSink& log,
                                      std::int64_t first_open) {
  if (!free_units()) settle_units();
  bring_together();
  PlaceGraph graph = place_graph();
  PoseGraphReport report = optimize_pose_graph(graph.pose_graph(), options, log);
  // Out of iterations is no reason to throw away what they gained.
  if (report.outcome || (report.outcome.code == Outcome::Code::kNotConverged &&
                         report.chi2_final < report.chi2_initial)) {
    report.outcome = Outcome::ok();
    graph.set_poses(report.graph);
    take_poses(graph);
    if (options_.merge)
      for (const Merger& merger : find_mergers(report.graph, first_open)) merge(merger);
    settle_units();
  }
  return report;
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
std::vector<PlaceMapper::Merger> PlaceMapper::find_mergers(const PoseGraph& graph,
                                                           std::int64_t first_open) const {
  std::map<std::int64_t, std::int64_t> last_keyframe;  // of every place
  for (const auto& [id, node] : nodes_) last_keyframe[parts_.at(node.part).place] = id;
  std::vector<Merger> mergers;
  std::set<std::int64_t> taken;
  std::optional<PoseMarginals> marginals;
  for (const Loop& loop : loops_) {
    const std::int64_t older = std::min(place_of(loop.match), place_of(loop.query));
    const std::int64_t younger = std::max(place_of(loop.match), place_of(loop.query));
    if (older == younger || taken.count(older) || taken.count(younger)) continue;
    const PlaceState &a = places_.at(older), &b = places_.at(younger);
    if (last_keyframe.at(younger) >= first_open || a.anchor_keyframe >= first_open) continue;
    const Sim3 S_a_b = a.S_map_place.inverse() * b.S_map_place;
    if (S_a_b.translation().norm() >= a.reach ||
        S_a_b.rotation().log().norm() >= options_.max_angle_deg * M_PI / 180 || !agrees(loop))
      continue;
    if (!marginals) marginals.emplace(graph);
    if (!marginals->outcome()) break;
    const Information covariance = marginals->relative_covariance(older, younger);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
        Eigen::Matrix3d(covariance.topLeftCorner<3, 3>()), Eigen::EigenvaluesOnly);
    if (std::sqrt(eigen.eigenvalues()[2]) > options_.merge_sigma * b.reach) continue;
    Merger merger{older, younger, Matrix7d::Zero()};
    merger.covariance.topLeftCorner(covariance.rows(), covariance.cols()) = covariance;
    mergers.push_back(merger);
    taken.insert({older, younger});
  }
  return mergers;
}

/// The parts of the younger place become parts of the older one, where the map has them now;
/// constraints follow from the parts.
void PlaceMapper::merge(const Merger& merger) {
  const Sim3 S_older_younger =
      places_.at(merger.older).S_map_place.inverse() * places_.at(merger.younger).S_map_place;
  for (auto& [anchor, part] : parts_) {
    if (part.place != merger.younger) continue;
    const Matrix7d adjoint = part.S_place_part.inverse().adjoint();
    part.covariance += adjoint * merger.covariance * adjoint.transpose();
    part.S_place_part = S_older_younger * part.S_place_part;
    part.place = merger.older;
  }
  places_.erase(merger.younger);
}

}  // namespace placegraph
