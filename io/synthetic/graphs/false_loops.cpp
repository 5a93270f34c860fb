#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/position_of.h>
#include <placegraph/io/synthetic/graphs/false_loops.h>

#include <Eigen/Geometry>

namespace placegraph::synthetic {
namespace {

constexpr double kFarShare = 0.1;  ///< least distance of the ends, as a share of the map's diagonal
constexpr int kDraws = 100000;     ///< most pairs drawn until one is far apart
constexpr int kMaxLoops = 1000000;
/// Streams of the seed that are not used by any world.
constexpr std::uint64_t kLoopStream = 1, kOrderStream = 2;

std::vector<RelativePoseConstraint> loops_of(const PoseGraph& graph) {
  std::vector<RelativePoseConstraint> loops;
  for (const Constraint& constraint : graph.constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      if (edge->source == ConstraintSource::kLoop) loops.push_back(*edge);
  return loops;
}

std::vector<Eigen::Vector3d> positions_of(const PoseGraph& graph) {
  std::vector<Eigen::Vector3d> positions;
  for (const PoseNode& node : graph.nodes) positions.push_back(position_of(node.T_world_node));
  return positions;
}

}  // namespace

void add_false_loops(PoseGraph& graph, int count, std::uint64_t seed) {
  if (count < 0 || count > kMaxLoops)
    throw ArgumentError("false loops: must be from 0 to " + std::to_string(kMaxLoops));
  if (count == 0) return;
  const std::vector<RelativePoseConstraint> loops = loops_of(graph);
  if (loops.empty()) throw ArgumentError("false loops: the graph has no loop to copy");
  const std::vector<Eigen::Vector3d> positions = positions_of(graph);
  Eigen::AlignedBox3d map;
  for (const Eigen::Vector3d& position : positions) map.extend(position);
  const double far_m = kFarShare * map.diagonal().norm();

  Random random(seed, kLoopStream);
  const int nodes = static_cast<int>(positions.size());
  for (int k = 0; k < count; ++k) {
    RelativePoseConstraint loop = loops[random.index(static_cast<int>(loops.size()))];
    int draws = 0;
    int i, j;
    do {
      if (++draws > kDraws)
        throw ArgumentError("false loops: hardly any two poses are far apart in the graph");
      i = random.index(nodes);
      j = random.index(nodes);
      loop.from = graph.nodes[std::min(i, j)].id;
      loop.to = graph.nodes[std::max(i, j)].id;
    } while (!((positions[i] - positions[j]).norm() > far_m) ||
             std::abs(loop.from.value() - loop.to.value()) == 1);  // not an odometry edge
    graph.constraints.emplace_back(loop);
  }
}

void shuffle_constraints(PoseGraph& graph, std::uint64_t seed) {
  Random random(seed, kOrderStream);  // Fisher and Yates
  for (std::size_t left = graph.constraints.size(); left > 1; --left)
    std::swap(graph.constraints[left - 1], graph.constraints[random.index(static_cast<int>(left))]);
}

}  // namespace placegraph::synthetic
