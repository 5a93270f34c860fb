#include <placegraph/graph/geometry/bounded_covariance.h>
#include <placegraph/pipeline/places/place_constraints.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Minimum variance of the logarithm of a scale, even where it is measured.
constexpr double kScaleVariance = 1e-6;

/// Covariance of a tangent vector in another frame: Ad C Ad^T.
Matrix7d transported(const Matrix7d& adjoint, const Matrix7d& covariance) {
  return adjoint * covariance * adjoint.transpose();
}

PlaceEdge odometry_edge(const KeyframeChain& chain, const PlacePartition& partition,
                        KeyframeId previous, KeyframeId anchor, const Matrix7d& chained) {
  PlaceEdge edge{{PlaceConstraint::Kind::kLink, anchor.value()},
                 previous,
                 anchor,
                 Sim3(chain.T_a_b(previous, anchor)),
                 chained,
                 ConstraintSource::kOdometry};
  if (const auto& covariance = partition.segments().at(anchor).motion_covariance) {
    edge.covariance.setZero();
    edge.covariance.topLeftCorner<6, 6>() = *covariance;
    edge.covariance(6, 6) = chained(6, 6);
  }
  return edge;
}

RobustKernel kernel_of(const PlaceEdge& edge, const PlaceOptions& options) {
  if (edge.key.first == PlaceConstraint::Kind::kMotion) return options.motion_kernel;
  return edge.source == ConstraintSource::kOdometry ? RobustKernel() : options.loop_kernel;
}

}  // namespace

std::vector<PlaceEdge> link_edges(const KeyframeChain& chain, const PlacePartition& partition,
                                  KeyframeId since) {
  std::vector<PlaceEdge> result;
  auto at = chain.keyframes().lower_bound(since);
  if (at == chain.keyframes().end()) return result;
  // Covariances are accumulated from an anchor on.
  KeyframeId begin = partition.segment_of(at->first);
  if (begin == at->first) begin = partition.previous_anchor(chain, begin).value_or(begin);
  Matrix7d chained = Matrix7d::Zero();
  for (at = chain.keyframes().find(begin); at != chain.keyframes().end(); ++at) {
    const auto& [id, keyframe] = *at;
    if (id == begin && id < since) continue;
    if (!keyframe.link) {
      chained.setZero();
      continue;
    }
    const KeyframeLink& link = *keyframe.link;
    const Sim3 S_from_this(link.T_from_this.rotation(), link.T_from_this.translation(), link.scale);
    if (link.source != ConstraintSource::kOdometry) {
      result.push_back({{PlaceConstraint::Kind::kLink, id.value()},
                        partition.segment_of(link.from),
                        id,
                        Sim3(partition.T_segment_keyframe(chain, link.from)) * S_from_this,
                        keyframe.link_covariance,
                        link.source});
      chained.setZero();
      continue;
    }
    chained = transported(S_from_this.inverse().adjoint(), chained) + keyframe.link_covariance;
    if (!partition.is_anchor(id)) continue;
    result.push_back(odometry_edge(chain, partition, partition.segment_of(link.from), id, chained));
    chained.setZero();
  }
  return result;
}

PlaceEdge loop_edge(const KeyframeChain& chain, const PlacePartition& partition, const Loop& loop,
                    std::size_t number) {
  const Sim3 S_segment_match(partition.T_segment_keyframe(chain, loop.match)),
      S_segment_query(partition.T_segment_keyframe(chain, loop.query));
  Matrix7d covariance = Matrix7d::Zero();
  if (loop.information(6, 6) > 0 && !chain.all_scales_known()) {
    covariance = bounded_covariance(loop.information);
  } else {
    covariance.topLeftCorner<6, 6>() =
        bounded_covariance(Matrix6d(loop.information.topLeftCorner<6, 6>()));
    covariance(6, 6) = kScaleVariance;
  }
  return {{PlaceConstraint::Kind::kLoop, static_cast<std::int64_t>(number)},
          partition.segment_of(loop.match),
          partition.segment_of(loop.query),
          S_segment_match * loop.S_match_query() * S_segment_query.inverse(),
          transported(S_segment_query.adjoint(), covariance),
          ConstraintSource::kLoop};
}

std::optional<PlaceEdge> motion_edge(const KeyframeChain& chain, const PlaceHistory::Motion& motion,
                                     std::size_t number) {
  if (!chain.scale_known(motion.from) || !chain.scale_known(motion.to)) return std::nullopt;
  PlaceEdge edge{{PlaceConstraint::Kind::kMotion, static_cast<std::int64_t>(number)},
                 motion.from,
                 motion.to,
                 Sim3(motion.T_from_to),
                 Matrix7d::Zero(),
                 ConstraintSource::kOther};
  edge.covariance.topLeftCorner<6, 6>() = motion.covariance;
  edge.covariance(6, 6) = kScaleVariance;
  return edge;
}

RelativePoseConstraint constraint_between_places(const PlacePartition& partition,
                                                 const PlaceEdge& edge, bool all_scales_known) {
  const PlacePartition::Segment &from = partition.segments().at(edge.from_segment),
                                &to = partition.segments().at(edge.to_segment);
  const Sim3 S_from_to = from.S_place_segment * edge.S_from_to * to.S_place_segment.inverse();
  Matrix7d covariance = transported(edge.S_from_to.inverse().adjoint(), from.covariance) +
                        edge.covariance + to.covariance;
  covariance = transported(to.S_place_segment.adjoint(), covariance);

  RelativePoseConstraint constraint;
  constraint.from = node_of_place(from.place);
  constraint.to = node_of_place(to.place);
  constraint.source = edge.source;
  // Keeps the inverse finite: deviations of 1e-9, near the rounding of poses. Chosen.
  constexpr double kLeastVariance = 1e-18;
  if (all_scales_known) {
    constraint.T_from_to = rigid_part(S_from_to);
    constraint.information =
        bounded_inverse(Matrix6d(covariance.topLeftCorner<6, 6>()), kLeastVariance);
  } else {
    covariance(6, 6) += kScaleVariance;
    constraint.T_from_to = S_from_to;
    constraint.information = bounded_inverse(covariance, kLeastVariance);
  }
  return constraint;
}

std::vector<PlaceConstraint> place_constraints(const KeyframeChain& chain,
                                               const PlacePartition& partition,
                                               const std::vector<Loop>& loops,
                                               const std::vector<PlaceHistory::Motion>& motions,
                                               const PlaceOptions& options, KeyframeId since) {
  std::vector<PlaceEdge> edges = link_edges(chain, partition, since);
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (std::max(loops[i].match, loops[i].query) >= since)
      edges.push_back(loop_edge(chain, partition, loops[i], i));
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (motions[i].to < since) continue;
    if (const auto edge = motion_edge(chain, motions[i], i)) edges.push_back(*edge);
  }

  std::vector<PlaceConstraint> result;
  const bool all_scales_known = chain.all_scales_known();
  for (const PlaceEdge& edge : edges) {
    result.push_back({edge.key, std::nullopt});
    if (partition.segments().at(edge.from_segment).place ==
        partition.segments().at(edge.to_segment).place)
      continue;
    auto& measured = result.back().measured;
    measured = constraint_between_places(partition, edge, all_scales_known);
    measured->kernel = kernel_of(edge, options);
  }
  return result;
}

}  // namespace placegraph
