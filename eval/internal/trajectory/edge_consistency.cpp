#include <placegraph/eval/internal/trajectory/edge_consistency.h>
#include <placegraph/eval/trajectory/statistics.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/core/chi_squared.h>

namespace placegraph {

EdgeConsistency edge_consistency(const std::vector<RelativePoseConstraint>& edges,
                                 const std::map<NodeId, SE3>& T_world_node) {
  constexpr int kDof = 6;
  const double bound = chi_squared_quantile(0.99, kDof) / kDof;
  EdgeConsistency result;
  std::vector<double> nees;
  int beyond = 0;
  for (const RelativePoseConstraint& edge : edges) {
    require(std::holds_alternative<SE3>(edge.T_from_to) && edge.information.rows() == kDof,
            "the graph has no metric scale (its edges are similarities)");
    const auto from = T_world_node.find(edge.from), to = T_world_node.find(edge.to);
    if (from == T_world_node.end() || to == T_world_node.end()) {
      ++result.unknown;
      continue;
    }
    const SE3 T_true = from->second.inverse() * to->second;
    const Vector6d e = (std::get<SE3>(edge.T_from_to).inverse() * T_true).log();
    nees.push_back(e.dot(edge.information * e) / kDof);
    beyond += nees.back() > bound;
  }
  if (nees.empty()) return result;
  const Statistics statistics = statistics_of(nees);
  result.edges = statistics.count;
  result.mean_nees = statistics.mean;
  result.median_nees = statistics.median;
  result.share_beyond_99 = static_cast<double>(beyond) / statistics.count;
  return result;
}

}  // namespace placegraph
