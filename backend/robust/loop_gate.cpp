#include <placegraph/backend/robust/loop_gate.h>
#include <placegraph/graph/core/chi_squared.h>

#include <algorithm>
#include <numbers>

namespace placegraph {
namespace {

/// Factor of the gate for a loop that is nearly right.
constexpr double kNearlyRightFactor = 20;

/// Length of the diagonal of the box around all poses [m].
template <class Group>
double extent_of(const PackedGraph<Group>& graph) {
  typename Group::Point low = graph.poses.front().translation(), high = low;
  for (const Group& pose : graph.poses) {
    low = low.cwiseMin(pose.translation());
    high = high.cwiseMax(pose.translation());
  }
  return (high - low).norm();
}

}  // namespace

template <class Group>
LoopGate<Group>::LoopGate(const PackedGraph<Group>& graph, double probability, double noise_scale,
                          const LoopGateWidth& width)
    : width_(width),
      quantile_(chi_squared_quantile(probability, Group::kDof)),
      scale_(noise_scale),
      extent_(extent_of(graph)),
      limit_(of_noise()) {}

template <class Group>
double LoopGate<Group>::of_loop(const PackedGraph<Group>& graph, int edge) const {
  return nearly_right(graph, edge) ? kNearlyRightFactor * limit_ : limit_;
}

template <class Group>
double LoopGate<Group>::widest() const {
  return kNearlyRightFactor * limit_;
}

template <class Group>
void LoopGate<Group>::learn(const PackedGraph<Group>& graph, const std::vector<double>& chi2) {
  double sum = 0, worst = 0;
  int loops = 0;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (graph.edges[i].weight <= 0 || graph.edges[i].odometry) continue;
    ++loops;
    sum += chi2[i];
    worst = std::max(worst, chi2[i]);
  }
  if (loops > 0) scale_ = std::max(scale_, sum / (Group::kDof * loops));
  limit_ = std::max(of_noise(), width_.tail * std::min(worst, limit_));
}

template <class Group>
void LoopGate<Group>::widen(double chi2) {
  if (chi2 <= limit_) limit_ = std::max(limit_, width_.tail * chi2);
}

template <class Group>
bool LoopGate<Group>::nearly_right(const PackedGraph<Group>& graph, int index) const {
  const auto& edge = graph.edges[index];
  const typename Group::Tangent error =
      (edge.T_to_from * (graph.poses[edge.from].inverse() * graph.poses[edge.to])).log();
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  return error.template head<dim>().norm() <= width_.nearly_right * extent_ &&
         error.template tail<Group::kDof - dim>().norm() <= width_.nearly_right * std::numbers::pi;
}

template class LoopGate<SE2>;
template class LoopGate<SE3>;
template class LoopGate<Sim3>;

}  // namespace placegraph
