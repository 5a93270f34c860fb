#include <placegraph/eval/edges/edge_consistency.h>
#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/chi_squared.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Sums over the edges of one source.
class Judgement {
 public:
  explicit Judgement(PoseKind kind) : names_(edge_axes(kind)), axes_(names_.size()) {}

  void add(const EdgeError& edge);
  /// `fitted` parameters have made the errors smaller.
  EdgeConsistency result(double fitted) const;

 private:
  struct AxisSums {
    int count = 0;
    double error = 0, stated = 0, of_truth = 0, normalized = 0;
  };
  /// The NEES of every edge.
  struct Values {
    std::vector<double> nees;
    int beyond = 0;
    void add(const EdgeError& edge, const Eigen::MatrixXd& covariance);
    Nees result(double factor) const;
  };
  const std::vector<std::string>& names_;
  std::vector<AxisSums> axes_;
  Values by_stated_, with_truth_;
  double squares_ = 0, squares_of_truth_ = 0;
  EdgeConsistency result_;
};

void Judgement::Values::add(const EdgeError& edge, const Eigen::MatrixXd& covariance) {
  const int dof = static_cast<int>(edge.axes.size());
  const double square = edge.error.dot(covariance.ldlt().solve(edge.error));
  nees.push_back(square / dof);
  beyond += square > chi_squared_quantile(0.99, dof);
}

Nees Judgement::Values::result(double factor) const {
  if (nees.empty()) return {};
  const Statistics statistics = statistics_of(nees);
  return {factor * statistics.mean, factor * statistics.median,
          static_cast<double>(beyond) / statistics.count};
}

void Judgement::add(const EdgeError& edge) {
  result_.unknown += edge.state == EdgeState::kUnknown;
  result_.interpolated += edge.state == EdgeState::kInterpolated;
  if (edge.state != EdgeState::kJudged) return;
  ++result_.edges;
  result_.degrees_of_freedom += static_cast<int>(edge.axes.size());
  by_stated_.add(edge, edge.stated);
  with_truth_.add(edge, edge.stated + edge.of_truth);
  const auto stated = edge.stated.ldlt();
  squares_ += edge.error.dot(stated.solve(edge.error));
  squares_of_truth_ += stated.solve(edge.of_truth).trace();
  for (std::size_t k = 0; k < edge.axes.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    AxisSums& axis = axes_[static_cast<std::size_t>(edge.axes[k])];
    const double square = edge.error[i] * edge.error[i];
    ++axis.count;
    axis.error += square;
    axis.stated += edge.stated(i, i);
    axis.of_truth += edge.of_truth(i, i);
    axis.normalized += square / (edge.stated(i, i) + edge.of_truth(i, i));
  }
}

EdgeConsistency Judgement::result(double fitted) const {
  EdgeConsistency result = result_;
  if (result.edges == 0) return result;
  const double all = result.degrees_of_freedom, left = std::max(1.0, all - fitted);
  result.degrees_of_freedom = static_cast<int>(std::lround(left));
  result.by_stated = by_stated_.result(all / left);
  result.with_truth = with_truth_.result(all / left);
  if (squares_of_truth_ > 0) result.truth_share = std::min(1.0, squares_of_truth_ / squares_);
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const AxisSums& axis = axes_[k];
    if (axis.count == 0) continue;
    const auto root = [&](double sum) { return std::sqrt(sum / axis.count); };
    result.axes.push_back({names_[k], root(axis.error), root(axis.stated), root(axis.of_truth),
                           root(axis.normalized)});
  }
  return result;
}

}  // namespace

std::map<ConstraintSource, EdgeConsistency> edge_consistency(
    const std::vector<RelativePoseConstraint>& edges, const TrueNodes& truth) {
  const std::vector<EdgeError> errors = edge_errors(edges, truth);
  std::map<ConstraintSource, Judgement> judgements;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const PoseKind kind = kind_of(edges[i].T_from_to);
    judgements.try_emplace(edges[i].source, kind).first->second.add(errors[i]);
  }
  std::map<ConstraintSource, EdgeConsistency> result;
  for (const auto& [source, judgement] : judgements)
    result[source] = judgement.result(source == ConstraintSource::kOdometry ? truth.fitted : 0);
  return result;
}

}  // namespace placegraph
