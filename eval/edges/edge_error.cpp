#include <placegraph/eval/edges/edge_error.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

constexpr int kScale = 6;  // number of the log scale in edge_axes() of similarities

/// The covariance of an information matrix; very large where there is no information.
Eigen::MatrixXd covariance_of(const Information& information) {
  const Eigen::Index size = information.rows();
  Eigen::MatrixXd regular = information;
  regular.diagonal().array() += 1e-14 * information.diagonal().maxCoeff();
  return regular.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
}

/// Maps tangents at the end of an edge of direction `along` and `length` there to edge_axes() of
/// similarities: translations along it, sideways and upright, relative to its length.
Matrix7d axes_of_direction(const Eigen::Vector3d& along, double length) {
  const Eigen::Vector3d upright =
      std::abs(along.y()) < 0.99 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d sideways = upright.cross(along).normalized();
  Matrix7d axes = Matrix7d::Identity();
  axes.topLeftCorner<3, 3>() << along.transpose(), sideways.transpose(),
      along.cross(sideways).transpose();
  axes.topLeftCorner<3, 3>() /= length;
  return axes;
}

/// A similarity edge against the truth, in edge_axes().
struct Comparison {
  Vector7d error;
  Matrix7d stated, of_truth;
};

Comparison compare(const RelativePoseConstraint& edge, const TrueNodes& truth, const Sim3& S_true) {
  const Sim3& S = std::get<Sim3>(edge.T_from_to);
  const Eigen::Vector3d t = S.rotation().inverse() * S.translation();
  const double true_length =
      (truth.T_world_node.at(edge.from).inverse() * truth.T_world_node.at(edge.to))
          .translation()
          .norm();
  const Matrix7d axes = axes_of_direction(t.normalized(), t.norm() / S.scale()),
                 metric = axes_of_direction(t.normalized(), true_length);
  Comparison result;
  result.error = axes * (S.inverse() * S_true).log();
  result.stated = axes * covariance_of(edge.information) * axes.transpose();
  result.of_truth = Matrix7d::Zero();
  result.of_truth.topLeftCorner<6, 6>() = truth.covariance(edge.from, edge.to);
  result.of_truth = metric * result.of_truth * metric.transpose();
  return result;
}

/// Covariance of an edge's error if the scales of its ends have been measured. An edge that gives
/// the scale of its begin has no error of length left: its relative error goes into the scale.
Matrix7d with_scales(const Matrix7d& covariance, bool gives_scale, double begin, double end) {
  Vector7d by_begin = Vector7d::Zero();
  by_begin[0] = by_begin[kScale] = 1;  // a larger scale makes the true length and scale smaller
  Matrix7d result = covariance;
  if (gives_scale) {
    Matrix7d rest = Matrix7d::Identity();
    rest.col(0) -= by_begin;
    result = rest * covariance * rest.transpose();
  } else {
    result += by_begin * by_begin.transpose() * begin;
  }
  result(kScale, kScale) += end;
  return result;
}

double true_length(const RelativePoseConstraint& edge, const TrueNodes& truth) {
  const auto from = truth.T_world_node.find(edge.from), to = truth.T_world_node.find(edge.to);
  if (from == truth.T_world_node.end() || to == truth.T_world_node.end()) return 0;
  return (from->second.inverse() * to->second).translation().norm();
}

double measured_length(const RelativePoseConstraint& edge) {
  return std::get<Sim3>(edge.T_from_to).translation().norm();
}

EdgeError rigid_edge_error(const RelativePoseConstraint& edge, const TrueNodes& truth) {
  const SE3 T_true = truth.T_world_node.at(edge.from).inverse() * truth.T_world_node.at(edge.to);
  EdgeError result;
  result.state = EdgeState::kJudged;
  result.axes = {0, 1, 2, 3, 4, 5};
  result.error = (std::get<SE3>(edge.T_from_to).inverse() * T_true).log();
  result.stated = covariance_of(edge.information);
  result.of_truth = truth.covariance(edge.from, edge.to);
  return result;
}

/// Errors of the edges of a graph over Sim(3).
class SimilarityErrors {
 public:
  SimilarityErrors(const std::vector<RelativePoseConstraint>& edges, const TrueNodes& truth);

  /// The error of edge `index`, of which the truth has both nodes.
  EdgeError error_of(std::size_t index) const;

 private:
  /// Ratio of true to measured length, with the variances of its logarithm.
  struct NodeScale {
    std::size_t edge = 0;
    double ratio = 0;
    double stated = 0, of_truth = 0;
  };
  bool has_length(const RelativePoseConstraint& edge) const;

  const std::vector<RelativePoseConstraint>& edges_;
  const TrueNodes& truth_;
  double least_measured_ = 0, least_true_ = 0;  // lengths of edges that have a direction
  std::map<NodeId, NodeScale> scales_;
};

SimilarityErrors::SimilarityErrors(const std::vector<RelativePoseConstraint>& edges,
                                   const TrueNodes& truth)
    : edges_(edges), truth_(truth) {
  constexpr double kShort = 1e-3;  // relative to the median
  std::vector<double> measured, real;
  for (const RelativePoseConstraint& edge : edges) {
    if (edge.source != ConstraintSource::kOdometry || true_length(edge, truth) <= 0) continue;
    measured.push_back(measured_length(edge));
    real.push_back(true_length(edge, truth));
  }
  if (measured.empty()) return;
  least_measured_ = kShort * median_of(measured);
  least_true_ = kShort * median_of(real);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const RelativePoseConstraint& edge = edges[i];
    if (edge.source != ConstraintSource::kOdometry || !has_length(edge)) continue;
    if (truth.is_interpolated(edge.from) || truth.is_interpolated(edge.to)) continue;
    const Comparison c = compare(edge, truth, std::get<Sim3>(edge.T_from_to));
    scales_.try_emplace(edge.from, NodeScale{i, true_length(edge, truth) / measured_length(edge),
                                             c.stated(0, 0), c.of_truth(0, 0)});
  }
}

bool SimilarityErrors::has_length(const RelativePoseConstraint& edge) const {
  return least_true_ > 0 && least_measured_ > 0 && measured_length(edge) > least_measured_ &&
         true_length(edge, truth_) > least_true_;
}

EdgeError SimilarityErrors::error_of(std::size_t index) const {
  const RelativePoseConstraint& edge = edges_[index];
  const auto begin = scales_.find(edge.from), end = scales_.find(edge.to);
  if (begin == scales_.end() || !has_length(edge)) return {};
  const bool gives_scale = begin->second.edge == index, scale = end != scales_.end();
  const SE3 T_true = truth_.T_world_node.at(edge.from).inverse() * truth_.T_world_node.at(edge.to);
  const double unit = begin->second.ratio,
               s = scale ? end->second.ratio / unit : std::get<Sim3>(edge.T_from_to).scale();
  const Comparison c =
      compare(edge, truth_, Sim3(T_true.rotation(), T_true.translation() / unit, s));
  const Matrix7d stated = with_scales(c.stated, gives_scale, begin->second.stated,
                                      scale ? end->second.stated : 0),
                 of_truth = with_scales(c.of_truth, gives_scale, begin->second.of_truth,
                                        scale ? end->second.of_truth : 0);
  EdgeError result;
  result.state = EdgeState::kJudged;
  for (int k = gives_scale ? 1 : 0; k < (scale ? 7 : 6); ++k) result.axes.push_back(k);
  result.error = c.error(result.axes);
  result.stated = stated(result.axes, result.axes);
  result.of_truth = of_truth(result.axes, result.axes);
  return result;
}

}  // namespace

const std::vector<std::string>& edge_axes(PoseKind kind) {
  static const std::vector<std::string> rigid = {"translation along x", "translation along y",
                                                 "translation along z", "rotation about x",
                                                 "rotation about y",    "rotation about z"};
  static const std::vector<std::string> similar = {
      "length",           "direction sideways", "direction upright", "rotation about x",
      "rotation about y", "rotation about z",   "change of scale"};
  return kind == PoseKind::kSim3 ? similar : rigid;
}

bool TrueNodes::is_interpolated(NodeId node) const {
  const auto frame = frames.find(node);
  return frame != frames.end() && noise.is_interpolated(frame->second);
}

Matrix6d TrueNodes::covariance(NodeId from, NodeId to) const {
  const auto begin = frames.find(from), end = frames.find(to);
  const bool known = begin != frames.end() && end != frames.end();
  return noise.covariance(T_world_node.at(from).inverse() * T_world_node.at(to),
                          known ? end->second - begin->second : 1);
}

std::vector<EdgeError> edge_errors(const std::vector<RelativePoseConstraint>& edges,
                                   const TrueNodes& truth) {
  if (edges.empty()) return {};
  const PoseKind kind = kind_of(edges.front().T_from_to);
  require(kind != PoseKind::kSE2, "edges over SE(3) or Sim(3) are needed");
  for (const RelativePoseConstraint& edge : edges)
    require(kind_of(edge.T_from_to) == kind && edge.information.rows() == degrees_of_freedom(kind),
            "the edges are not all of one kind");
  std::optional<SimilarityErrors> similarities;
  if (kind == PoseKind::kSim3) similarities.emplace(edges, truth);
  std::vector<EdgeError> errors(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const RelativePoseConstraint& edge = edges[i];
    if (!truth.T_world_node.contains(edge.from) || !truth.T_world_node.contains(edge.to)) continue;
    if (truth.is_interpolated(edge.from) || truth.is_interpolated(edge.to))
      errors[i].state = EdgeState::kInterpolated;
    else
      errors[i] = similarities ? similarities->error_of(i) : rigid_edge_error(edge, truth);
  }
  return errors;
}

}  // namespace placegraph
