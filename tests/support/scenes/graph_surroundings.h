#pragma once
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/packed_graphs.h"
#include "tests/support/scenes/looped_walk.h"

namespace placegraph::test {

/// What else a file of a graph may have: drawn each with probability 1/2, and always one of them.
struct Surroundings {
  bool lone_vertices = false;     ///< held vertices without edges, some of them far away
  bool second_component = false;  ///< a walk with loops and a false one of its own
  bool surveyed_chain = false;    ///< a chain of fixed vertices with measured steps
  bool parallel_edges = false;    ///< odometry in two edges of half its information
  bool shuffled = false;          ///< vertices and constraints in a random order
  bool renumbered = false;        ///< random ids

  static Surroundings draw(Random& random) {
    Surroundings s;
    for (bool* drawn : {&s.lone_vertices, &s.second_component, &s.surveyed_chain, &s.parallel_edges,
                        &s.shuffled, &s.renumbered})
      *drawn = random.uniform() < 0.5;
    if (!s.any()) s.lone_vertices = true;
    return s;
  }
  bool any() const {
    return lone_vertices || second_component || surveyed_chain || parallel_edges || shuffled ||
           renumbered;
  }
  std::string text() const {
    std::string names;
    if (lone_vertices) names += " lone vertices,";
    if (second_component) names += " a second component,";
    if (surveyed_chain) names += " a surveyed chain,";
    if (parallel_edges) names += " parallel edges,";
    if (shuffled) names += " shuffled,";
    if (renumbered) names += " renumbered,";
    return names;
  }
};

/// A graph in surroundings that must not change its solution. Its first node is fixed.
template <class Group>
class SurroundedGraph {
 public:
  SurroundedGraph(const PoseGraph& original, const Surroundings& surroundings, Random& random)
      : graph(original) {
    graph.nodes.front().fixed = true;
    for (std::size_t i = 0; i < original.nodes.size(); ++i) node.push_back(static_cast<int>(i));
    for (std::size_t i = 0; i < original.constraints.size(); ++i)
      constraint.push_back(static_cast<int>(i));
    for (const PoseNode& each : original.nodes) next_id_ = std::max(next_id_, each.id.value() + 1);
    if (surroundings.parallel_edges) split_odometry(random);
    if (surroundings.lone_vertices) add_lone_vertices(random);
    if (surroundings.second_component)
      append(LoopedWalk<Group>({.nodes = 60, .lap = 20, .false_loops = 1, .seed = 3}).graph, false);
    if (surroundings.surveyed_chain) add_surveyed_chain(random);
    if (surroundings.shuffled) shuffle_all(random);
    if (surroundings.renumbered) renumber(random);
  }

  PoseGraph graph;
  std::vector<int> node;        ///< position of every node of the original
  std::vector<int> constraint;  ///< position of every constraint of the original

 private:
  void split_odometry(Random& random) {
    for (std::size_t i = 0, count = graph.constraints.size(); i < count; ++i) {
      auto& edge = std::get<RelativePoseConstraint>(graph.constraints[i]);
      if (edge.source != ConstraintSource::kOdometry || random.uniform() < 0.9) continue;
      edge.information *= 0.5;
      graph.constraints.push_back(Constraint(edge));
    }
  }
  void add_lone_vertices(Random& random) {
    const double extent_m = std::pow(10, random.uniform(0, 6));
    for (int k = 1 + random.index(200); k > 0; --k)
      graph.nodes.push_back(
          {NodeId(next_id_++), random_element<Group>(random, extent_m, 1), true});
  }
  void add_surveyed_chain(Random& random) {
    PoseGraph chain;
    Group T;
    for (int i = 0; i < 30; ++i) {
      chain.nodes.push_back({NodeId(i), T, true});
      const Group step = random_element<Group>(random, 1, 0.2);
      T = T * step;
      if (i + 1 < 30)
        chain.constraints.emplace_back(
            test::constraint<Group>(i, i + 1, step * random_element<Group>(random, 0.1, 0.1)));
    }
    append(chain, true);
  }
  void append(const PoseGraph& other, bool fixed) {
    const std::int64_t first = next_id_;
    for (PoseNode each : other.nodes) {
      each.id = NodeId(first + each.id.value());
      each.fixed = fixed;
      next_id_ = std::max(next_id_, each.id.value() + 1);
      graph.nodes.push_back(each);
    }
    for (const Constraint& each : other.constraints) {
      auto edge = std::get<RelativePoseConstraint>(each);
      edge.from = NodeId(first + edge.from.value());
      edge.to = NodeId(first + edge.to.value());
      graph.constraints.emplace_back(edge);
    }
  }
  template <class T>
  static void shuffle_with(std::vector<T>& values, std::vector<int>& positions, Random& random) {
    std::vector<int> order;
    for (std::size_t i = 0; i < values.size(); ++i) order.push_back(static_cast<int>(i));
    shuffle(order, random);
    std::vector<T> shuffled;
    std::vector<int> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      shuffled.push_back(values[order[i]]);
      place[order[i]] = static_cast<int>(i);
    }
    values = std::move(shuffled);
    for (int& position : positions) position = place[position];
  }
  void shuffle_all(Random& random) {
    shuffle_with(graph.nodes, node, random);
    shuffle_with(graph.constraints, constraint, random);
  }
  void renumber(Random& random) {
    const NodeIndex index = graph.index_by_id();
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
      ids.push_back(7 * static_cast<std::int64_t>(i) + random.index(7));
    shuffle(ids, random);
    for (Constraint& each : graph.constraints) {
      auto& edge = std::get<RelativePoseConstraint>(each);
      edge.from = NodeId(ids[index.at(edge.from)]);
      edge.to = NodeId(ids[index.at(edge.to)]);
    }
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) graph.nodes[i].id = NodeId(ids[i]);
  }

  std::int64_t next_id_ = 0;
};

}  // namespace placegraph::test
