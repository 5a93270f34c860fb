#include <placegraph/pipeline/place_mapper.h>

#include <Eigen/Dense>
#include <algorithm>

namespace placegraph {
namespace {

/// Inverse of a positive semi-definite matrix; eigenvalues below `floor` or 1e-12 of the largest
/// count as that much.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix, double floor) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (matrix + matrix.transpose()));
  const double least = std::max(floor, 1e-12 * eigen.eigenvalues().maxCoeff());
  const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(least).cwiseInverse();
  const Eigen::MatrixXd result =
      eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

/// Unknown directions get a large, finite variance.
Eigen::MatrixXd bounded_covariance(const Eigen::MatrixXd& information) {
  return inverse_of(information, 1e-6);
}

/// No unit of length is held better than this (variance of the log scale), though measured.
constexpr double kUnitVariance = 1e-6;

Eigen::MatrixXd transported(const Eigen::MatrixXd& adjoint, const Eigen::MatrixXd& covariance) {
  return adjoint * covariance * adjoint.transpose();
}

}  // namespace

PlaceMapper::Edge PlaceMapper::odometry_edge(std::int64_t anchor, std::int64_t previous,
                                             const Matrix7d& chained) const {
  const SE3 T_previous_anchor =
      nodes_.at(previous).T_run_keyframe.inverse() * nodes_.at(anchor).T_run_keyframe;
  Edge edge{previous, anchor, Sim3(T_previous_anchor), chained, ConstraintSource::kOdometry};
  if (const auto& information = parts_.at(anchor).information) {
    edge.covariance.setZero();
    edge.covariance.topLeftCorner<6, 6>() = bounded_covariance(*information);
    edge.covariance(6, 6) = chained(6, 6);
  }
  return edge;
}

PlaceMapper::Edge PlaceMapper::loop_edge(const Loop& loop) const {
  const Node &match = nodes_.at(loop.match), &query = nodes_.at(loop.query);
  const Sim3 S_part_query(T_part_keyframe(query));
  Edge edge{match.part,
            query.part,
            Sim3(T_part_keyframe(match)) * loop.S_match_query() * S_part_query.inverse(),
            Matrix7d::Zero(),
            ConstraintSource::kLoop,
            options_.loop_kernel};
  if (loop.information(6, 6) > 0 && free_units()) {
    edge.covariance = bounded_covariance(loop.information);
  } else {
    edge.covariance.topLeftCorner<6, 6>() =
        bounded_covariance(loop.information.topLeftCorner<6, 6>());
    edge.covariance(6, 6) = kUnitVariance;
  }
  edge.covariance = transported(S_part_query.adjoint(), edge.covariance);
  return edge;
}

/// Between the anchors of parts, as they were measured.
std::vector<PlaceMapper::Edge> PlaceMapper::edges() const {
  std::vector<Edge> result;
  // Along a run of tracking: covariances of the links add up between anchors.
  Matrix7d chained = Matrix7d::Zero();
  for (const auto& [id, node] : nodes_) {
    if (!node.link) {
      chained.setZero();
      continue;
    }
    const Link& link = *node.link;
    const Node& from = nodes_.at(link.from);
    const Sim3 S_from_this(link.T_from_this.rotation(), link.T_from_this.translation(), link.scale);
    Matrix7d covariance = Matrix7d::Zero();
    covariance.topLeftCorner<6, 6>() = bounded_covariance(link.information);
    covariance(6, 6) = link.sigma_log_scale * link.sigma_log_scale;
    if (link.source != ConstraintSource::kOdometry) {
      result.push_back({from.part, id, Sim3(T_part_keyframe(from)) * S_from_this, covariance,
                        link.source, options_.loop_kernel});
      chained.setZero();
      continue;
    }
    chained = transported(S_from_this.inverse().adjoint(), chained) + covariance;
    if (node.part != id) continue;
    result.push_back(odometry_edge(id, from.part, chained));
    chained.setZero();
  }
  for (const Loop& loop : loops_) result.push_back(loop_edge(loop));
  for (const Edge& motion : motions_) {
    // Metres say nothing where the unit is not the metre.
    if (units_differ(motion.from_part, motion.to_part)) continue;
    result.push_back(motion);
    result.back().covariance(6, 6) = kUnitVariance;
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
    constraint.information = inverse_of(covariance.topLeftCorner<6, 6>(), kLeastVariance);
  }
  return constraint;
}

}  // namespace placegraph
