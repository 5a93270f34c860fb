#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <algorithm>
#include <numbers>

namespace placegraph::test {

struct LoopedWalkOptions {
  int nodes = 400;
  int lap = 50;          ///< nodes until the walk comes by again
  int loop_every = 2;    ///< nodes between two true loops
  double noise = 0.02;   ///< of the measurements, in metres and radians
  double claimed = 0.1;  ///< what the information says the noise is
  int false_loops = 0;
  int cluster = 1;  ///< false loops that agree with each other
  std::uint64_t seed = 1;
};

/// A walk round and round a ring of `lap` metres (in 3D also upwards), with loops to the lap
/// before and false loops that claim two far poses to be at one place.
template <class Group>
struct LoopedWalk {
  explicit LoopedWalk(const LoopedWalkOptions& o) : random(o.seed), options(o) {
    typename Group::Tangent step = Group::Tangent::Zero();
    step[0] = 1;
    step[Group::kDof == 3 ? 2 : 5] = 2 * std::numbers::pi / o.lap;
    if (Group::kDof > 3) step[2] = 0.02;
    for (int i = 0; i < o.nodes; ++i)
      truth.push_back(i == 0 ? Group() : truth.back() * Group::exp(step) * disturbance(0.05));
    Group drifting;
    for (int i = 0; i < o.nodes; ++i) {
      if (i > 0) {
        const Group T_previous_this = measured(i - 1, i);
        drifting = drifting * T_previous_this;
        add(i - 1, i, T_previous_this, ConstraintSource::kOdometry);
      }
      graph.nodes.push_back({NodeId(i), drifting, false});
    }
    for (int i = o.lap; i < o.nodes; i += o.loop_every)
      add(i - o.lap, i, measured(i - o.lap, i), ConstraintSource::kLoop);
    true_constraints = graph.constraints.size();
    while (graph.constraints.size() < true_constraints + o.false_loops) add_false_cluster();
  }

  std::vector<Group> truth;
  PoseGraph graph;                   ///< starts at the odometry
  std::size_t true_constraints = 0;  ///< the constraints from here on are false

 private:
  Group disturbance(double sigma) {
    typename Group::Tangent xi;
    for (int k = 0; k < Group::kDof; ++k) xi[k] = sigma * random.normal();
    return Group::exp(xi);
  }
  Group measured(int from, int to) {
    return truth[from].inverse() * truth[to] * disturbance(options.noise);
  }
  void add(int from, int to, const Group& T_from_to, ConstraintSource source) {
    const double weight = 1 / (options.claimed * options.claimed);
    graph.constraints.emplace_back(RelativePoseConstraint{
        NodeId(from),
        NodeId(to),
        T_from_to,
        Information(Information::Identity(Group::kDof, Group::kDof) * weight),
        source,
        {}});
  }
  void add_false_cluster() {
    const int i = static_cast<int>(random.uniform(0, options.nodes - options.cluster));
    const int j = static_cast<int>(random.uniform(0, options.nodes - options.cluster));
    const auto distance = (truth[i].translation() - truth[j].translation()).norm();
    if (std::abs(i - j) < 2 * options.cluster || distance < 0.1 * options.lap) return;
    const Group T_i_j = disturbance(0.3);
    for (int k = 0; k < options.cluster; ++k)  // i + k seen as if i and j were at one place
      add(i + k, j + k,
          (truth[i].inverse() * truth[i + k]).inverse() * T_i_j *
              (truth[j].inverse() * truth[j + k]) * disturbance(options.noise),
          ConstraintSource::kLoop);
  }
  Random random;
  LoopedWalkOptions options;
};

}  // namespace placegraph::test
