#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/backend/georeference/map_scale.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {
// Nodes with a covariance: the cost. Chosen.
constexpr std::size_t kMostNodes = 64;
}  // namespace

std::optional<MapScale> map_scale(const PoseGraph& map, const PoseGraph& optimized) {
  if (map.kind() != PoseKind::kSim3) return std::nullopt;
  constexpr Eigen::Index kDof = Sim3::kDof;
  const std::vector<int> component = map.components();
  std::vector<std::size_t> first;  // nodes of the first component
  for (std::size_t i = 0; i < component.size(); ++i)
    if (component[i] == component[0]) first.push_back(i);
  const std::size_t count = std::min(first.size(), kMostNodes);
  std::vector<NodeId> ids;
  double log_scale = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first[k * first.size() / count];
    ids.push_back(map.nodes[i].id);
    log_scale +=
        std::log(scale_of(optimized.nodes[i].T_world_node) / scale_of(map.nodes[i].T_world_node));
  }
  const auto n = static_cast<double>(count);
  MapScale scale{std::exp(log_scale / n), std::numeric_limits<double>::infinity()};
  const PoseMarginals marginals(optimized);
  if (!marginals.outcome()) return scale;
  const Eigen::MatrixXd covariance = marginals.joint_covariance(ids);
  double sum = 0;  // over the entries of the logarithms of the scales
  for (Eigen::Index i = kDof - 1; i < covariance.rows(); i += kDof)
    for (Eigen::Index j = kDof - 1; j < covariance.cols(); j += kDof) sum += covariance(i, j);
  scale.sigma = scale.metres_per_unit * std::sqrt(std::max(0.0, sum)) / n;
  return scale;
}

}  // namespace placegraph
