#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include <Eigen/Dense>
#include <algorithm>

namespace placegraph {
namespace {

/// Inverse of a positive semi-definite matrix; eigenvalues below `floor` or 1e-12 of the largest
/// count as that much.
template <class Matrix>
Matrix inverse_of(const Matrix& matrix, double floor) {
  const Eigen::LLT<Matrix> factor(matrix);
  if (factor.info() == Eigen::Success && factor.rcond() > 1e-10) {
    const Matrix inverse = factor.solve(Matrix::Identity());
    // Its trace is above all its eigenvalues, so that none of the matrix is below the floor.
    if (inverse.trace() * floor < 1) return 0.5 * (inverse + inverse.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(0.5 * (matrix + matrix.transpose()));
  const double least = std::max(floor, 1e-12 * eigen.eigenvalues().maxCoeff());
  const Matrix result = eigen.eigenvectors() *
                        eigen.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
                        eigen.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

/// Unknown directions get a large, finite variance.
template <class Matrix>
Matrix bounded_covariance(const Matrix& information) {
  return inverse_of(information, 1e-6);
}

/// No unit of length is held better than this (variance of the log scale), though measured.
constexpr double kUnitVariance = 1e-6;

Matrix7d transported(const Matrix7d& adjoint, const Matrix7d& covariance) {
  return adjoint * covariance * adjoint.transpose();
}

}  // namespace

Matrix7d PlaceMapper::covariance_of(const Link& link) {
  Matrix7d covariance = Matrix7d::Zero();
  covariance.topLeftCorner<6, 6>() = bounded_covariance(link.information);
  covariance(6, 6) = link.sigma_log_scale * link.sigma_log_scale;
  return covariance;
}

void PlaceMapper::inform_anchor(std::int64_t anchor, const Matrix6d& information) {
  require(previous_anchor(anchor).has_value(),
          "PlaceMapper::inform_anchor: no anchor, or the first of its run");
  parts_.at(anchor).motion_covariance = bounded_covariance(information);
  changed(anchor);
}

PlaceMapper::Edge PlaceMapper::odometry_edge(std::int64_t anchor, std::int64_t previous,
                                             const Matrix7d& chained) const {
  const SE3 T_previous_anchor =
      nodes_.at(previous).T_run_keyframe.inverse() * nodes_.at(anchor).T_run_keyframe;
  Edge edge{{PlaceConstraint::Kind::kLink, anchor},
            previous,
            anchor,
            Sim3(T_previous_anchor),
            chained,
            ConstraintSource::kOdometry};
  if (const auto& covariance = parts_.at(anchor).motion_covariance) {
    edge.covariance.setZero();
    edge.covariance.topLeftCorner<6, 6>() = *covariance;
    edge.covariance(6, 6) = chained(6, 6);
  }
  return edge;
}

PlaceMapper::Edge PlaceMapper::loop_edge(std::size_t number) const {
  const Loop& loop = loops_[number];
  const Node &match = nodes_.at(loop.match), &query = nodes_.at(loop.query);
  const Sim3 S_part_query(T_part_keyframe(query));
  Edge edge{{PlaceConstraint::Kind::kLoop, static_cast<std::int64_t>(number)},
            match.part,
            query.part,
            Sim3(T_part_keyframe(match)) * loop.S_match_query() * S_part_query.inverse(),
            Matrix7d::Zero(),
            ConstraintSource::kLoop,
            options_.loop_kernel};
  if (loop.information(6, 6) > 0 && free_units()) {
    edge.covariance = bounded_covariance(loop.information);
  } else {
    edge.covariance.topLeftCorner<6, 6>() =
        bounded_covariance<Matrix6d>(loop.information.topLeftCorner<6, 6>());
    edge.covariance(6, 6) = kUnitVariance;
  }
  edge.covariance = transported(S_part_query.adjoint(), edge.covariance);
  return edge;
}

/// Along the runs of tracking: covariances of the links add up between anchors.
std::vector<PlaceMapper::Edge> PlaceMapper::link_edges(std::int64_t since) const {
  std::vector<Edge> result;
  auto node = nodes_.lower_bound(since);
  if (node == nodes_.end()) return result;
  // Chains begin at anchors.
  std::int64_t begin = node->second.part;
  if (begin == node->first) begin = previous_anchor(begin).value_or(begin);
  Matrix7d chained = Matrix7d::Zero();
  for (node = nodes_.find(begin); node != nodes_.end(); ++node) {
    const auto& [id, at] = *node;
    if (id == begin && id < since) continue;
    if (!at.link) {
      chained.setZero();
      continue;
    }
    const Node& from = nodes_.at(at.link->from);
    const SE3& T_from_this = at.link->T_from_this;
    const Sim3 S_from_this(T_from_this.rotation(), T_from_this.translation(), at.link->scale);
    if (at.link->source != ConstraintSource::kOdometry) {
      result.push_back({{PlaceConstraint::Kind::kLink, id},
                        from.part,
                        id,
                        Sim3(T_part_keyframe(from)) * S_from_this,
                        at.covariance,
                        at.link->source,
                        options_.loop_kernel});
      chained.setZero();
      continue;
    }
    chained = transported(S_from_this.inverse().adjoint(), chained) + at.covariance;
    if (at.part != id) continue;
    result.push_back(odometry_edge(id, from.part, chained));
    chained.setZero();
  }
  return result;
}

/// Between the anchors of parts, as they were measured: those that hang on keyframes from `since`
/// on.
std::vector<PlaceMapper::Edge> PlaceMapper::edges(std::int64_t since) const {
  std::vector<Edge> result = link_edges(since);
  for (std::size_t i = 0; i < loops_.size(); ++i)
    if (std::max(loops_[i].match, loops_[i].query) >= since) result.push_back(loop_edge(i));
  for (const Edge& motion : motions_) {
    // Metres say nothing where the unit is not the metre.
    if (motion.to_part < since || units_differ(motion.from_part, motion.to_part)) continue;
    result.push_back(motion);
    result.back().covariance(6, 6) = kUnitVariance;
  }
  return result;
}

std::vector<PlaceConstraint> PlaceMapper::constraints(std::int64_t since) const {
  std::vector<PlaceConstraint> result;
  for (const Edge& edge : edges(since)) {
    const bool inside = parts_.at(edge.from_part).place == parts_.at(edge.to_part).place;
    result.push_back({edge.key, inside ? std::nullopt : std::optional(constraint_of(edge))});
  }
  return result;
}

/// Between places: S_A_B = S_A_a S_a_b S_B_b^-1 of parts a and b, with the covariances of all
/// three.
RelativePoseConstraint PlaceMapper::constraint_of(const Edge& edge) const {
  const Part &from = parts_.at(edge.from_part), &to = parts_.at(edge.to_part);
  const Sim3 S_from_to = from.S_place_part * edge.S_from_to * to.S_place_part.inverse();
  Matrix7d covariance = transported(edge.S_from_to.inverse().adjoint(), from.covariance) +
                        edge.covariance + to.covariance;
  covariance = transported(to.S_place_part.adjoint(), covariance);

  RelativePoseConstraint constraint;
  constraint.from = from.place;
  constraint.to = to.place;
  constraint.source = edge.source;
  constraint.kernel = edge.kernel;
  constexpr double kLeastVariance = 1e-18;
  if (free_units()) {
    covariance(6, 6) += kUnitVariance;
    constraint.T_from_to = S_from_to;
    constraint.information = inverse_of(covariance, kLeastVariance);
  } else {
    constraint.T_from_to = SE3(S_from_to.rotation(), S_from_to.translation());
    constraint.information = inverse_of<Matrix6d>(covariance.topLeftCorner<6, 6>(), kLeastVariance);
  }
  return constraint;
}

}  // namespace placegraph
