#include <placegraph/backend/initialization/certified_initialization.h>
#include <placegraph/backend/initialization/incremental_initialization.h>
#include <placegraph/backend/initialization/initialization.h>
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/initialization/rotation_agreement.h>
#include <placegraph/backend/pose_graph/initialization_selection.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace placegraph {
namespace {

// Log odds, 400 to 1, that a ring holds no further turn. Chosen.
constexpr double kLogOdds = 6;
constexpr int kMostContinued = 4;   // continuations of a descent at its maximum of iterations
constexpr double kWithinReach = 2;  // cost over the lowest minimum, above which it is aborted
/// Maximum costs of the certified initialization and of the replay, in first descents. The
/// certified initialization may take at least this number of iterations; with a tight relaxation it
/// takes a few dozen.
constexpr double kCertifiedDescents = 5, kLeastCertifiedIterations = 200;
// As above. Chosen.
constexpr double kReplayDescents = 10;
constexpr double kCosineOfNear = 0.88;  // 0.5 rad

/// The residual rotation of an edge in the world frame, and the inverse of the rotation weight.
/// In the plane the rotation is the third component.
struct Residual {
  Eigen::Vector3d angles;
  double variance;
};

template <class Group>
std::vector<Residual> rotation_residuals(const PackedGraph<Group>& graph) {
  std::vector<Residual> residuals;
  residuals.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    const auto& R_world_to = graph.poses[edge.to].rotation();
    const auto E =
        edge.T_to_from.rotation() * (graph.poses[edge.from].rotation().inverse() * R_world_to);
    Residual residual;
    if constexpr (Group::kDof == 3)
      residual.angles = {0, 0, E.angle()};
    else
      residual.angles = R_world_to * E.log();
    const double weight = edge.weight * rotation_information<Group>(edge.information);
    residual.variance = weight > 0 ? 1 / weight : 0;
    residuals.push_back(residual);
  }
  return residuals;
}

/// Edges by node, without those that do not measure rotation.
struct Adjacency {
  std::vector<int> initialization, edge;
  template <class Edges>
  Adjacency(std::size_t nodes, const Edges& edges, const std::vector<Residual>& residuals)
      : initialization(nodes + 1, 0) {
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (residuals[k].variance == 0) continue;
      ++initialization[edges[k].from + 1];
      ++initialization[edges[k].to + 1];
    }
    for (std::size_t i = 0; i < nodes; ++i) initialization[i + 1] += initialization[i];
    edge.resize(initialization.back());
    std::vector<int> next(initialization.begin(), initialization.end() - 1);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (residuals[k].variance == 0) continue;
      edge[next[edges[k].from]++] = static_cast<int>(k);
      edge[next[edges[k].to]++] = static_cast<int>(k);
    }
  }
};

/// A breadth-first spanning forest from the anchors, and from nodes that no measured rotation
/// connects with them.
/// Every node has the sum of the residual rotations along the path from its root, and the sum of
/// their variances.
struct Tree {
  struct Node {
    Eigen::Vector3d angles = Eigen::Vector3d::Zero();
    double variance = -1;  // not reached yet
    int edge = -1;         // edge by which it was reached
  };
  std::vector<Node> nodes;
  int roots = 0;

  template <class Group>
  Tree(const PackedGraph<Group>& graph, const std::vector<Residual>& residuals)
      : nodes(graph.poses.size()) {
    const Adjacency adjacency(nodes.size(), graph.edges, residuals);
    std::vector<int> queue;
    queue.reserve(nodes.size());
    const auto begin_at = [&](std::size_t root) {
      nodes[root].variance = 0;
      ++roots;
      queue.push_back(static_cast<int>(root));
    };
    std::size_t next = 0;
    const auto grow = [&] {
      for (; next < queue.size(); ++next) {
        const int i = queue[next];
        for (int k = adjacency.initialization[i]; k < adjacency.initialization[i + 1]; ++k) {
          const int e = adjacency.edge[k];
          const bool forward = graph.edges[e].from == i;
          const int j = forward ? graph.edges[e].to : graph.edges[e].from;
          if (nodes[j].variance >= 0) continue;
          nodes[j].angles = nodes[i].angles + (forward ? 1 : -1) * residuals[e].angles;
          nodes[j].variance = nodes[i].variance + residuals[e].variance;
          nodes[j].edge = e;
          queue.push_back(j);
        }
      }
    };
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (graph.components.anchor[i]) begin_at(i);
    grow();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].variance < 0) {
        begin_at(i);
        grow();
      }
  }
};

/// A descent that continues beyond its maximum of iterations while its cost falls and is below
/// `worth`.
template <class Group>
LocalSolution descend_to_the_end(PackedGraph<Group>& graph, LocalSolver<Group>& solver,
                                 double worth = std::numeric_limits<double>::infinity()) {
  LocalSolution solution = solver.solve(graph);
  for (int round = 0; round < kMostContinued && !solution.outcome && solution.cost_final < worth;
       ++round) {
    LocalSolution next = solver.solve(graph);
    const bool fell = next.cost_final < solution.cost_final;
    solution.outcome = std::move(next.outcome);
    solution.iterations += next.iterations;
    solution.cost_final = next.cost_final;
    if (!fell) break;
  }
  return solution;
}

/// Whether a is preferred: convergence is decisive, then the lower cost.
bool better(const LocalSolution& a, const LocalSolution& b) {
  if (std::isfinite(a.cost_final) != std::isfinite(b.cost_final))
    return std::isfinite(a.cost_final);
  if (static_cast<bool>(a.outcome) != static_cast<bool>(b.outcome))
    return static_cast<bool>(a.outcome);
  return a.cost_final < b.cost_final;
}

/// Descents from several initializations; keeps the lowest minimum.
template <class Group>
class Candidates {
 public:
  Candidates(PackedGraph<Group>& graph, LocalSolver<Group>& solver)
      : graph_(graph), solver_(solver) {}

  void descend(std::vector<Group> poses, PoseGraphInitialization initialization) {
    starts_.push_back(poses);
    graph_.poses = std::move(poses);
    LocalSolution solution =
        best_.solution.outcome
            ? descend_to_the_end(graph_, solver_, kWithinReach * best_.solution.cost_final)
            : descend_to_the_end(graph_, solver_);
    iterations_ += solution.iterations;
    if (!poses_.empty() && !better(solution, best_.solution)) return;
    best_.solution = std::move(solution);
    best_.used = initialization;
    poses_ = graph_.poses;
  }
  /// Descends unless there was a descent from nearby poses.
  void descend_if_new(const std::vector<Group>& poses, PoseGraphInitialization initialization) {
    for (const std::vector<Group>& earlier : starts_)
      if (rotations_agree(earlier, poses)) return;
    descend(poses, initialization);
  }
  int iterations() const { return iterations_; }
  const LocalSolution& best() const { return best_.solution; }
  const std::vector<Group>& poses() const { return poses_; }
  /// Sets the graph to the lowest minimum.
  InitializedSolution take() {
    graph_.poses = std::move(poses_);
    best_.solution.iterations = iterations_;
    best_.refined_from_certified = best_.used == PoseGraphInitialization::kCertified;
    return std::move(best_);
  }

 private:
  PackedGraph<Group>& graph_;
  LocalSolver<Group>& solver_;
  std::vector<std::vector<Group>> starts_;
  std::vector<Group> poses_;
  InitializedSolution best_;
  int iterations_ = 0;
};

/// Whether every rotation error is small enough for steps of Gauss-Newton.
template <class Group>
bool rotations_are_near(const PackedGraph<Group>& graph) {
  for (const auto& edge : graph.edges) {
    if (edge.weight == 0) continue;
    const auto E = edge.T_to_from.rotation() *
                   (graph.poses[edge.from].rotation().inverse() * graph.poses[edge.to].rotation());
    if (!(cosine_of(E) > kCosineOfNear)) return false;
  }
  return true;
}

template <class Group>
InitializedSolution solve_automatically(PackedGraph<Group>& graph, RotationError rotation_error,
                                        LocalSolver<Group>& solver) {
  const std::vector<Group> file = graph.poses;
  std::vector<Group> chordal;
  bool file_first = rotations_are_near(graph);
  const auto make_chordal = [&] {
    chordal_initialization(graph, rotation_error);
    chordal = graph.poses;
  };
  if (!file_first) {
    const double file_cost = robust_cost(graph, rotation_error);
    make_chordal();
    // Poses of the input whose cost is not finite (extremely far off) are not selected.
    file_first = file_cost <= robust_cost(graph, rotation_error);
  }
  Candidates<Group> candidates(graph, solver);
  candidates.descend(file_first ? file : chordal, file_first ? PoseGraphInitialization::kFile
                                                             : PoseGraphInitialization::kChordal);
  if (candidates.best().outcome &&
      (windings_are_settled(graph) || certified_as_they_are(graph, rotation_error)))
    return candidates.take();
  graph.poses = chordal.empty() ? file : chordal;
  if (chordal.empty()) make_chordal();
  const double descent = std::max(1, candidates.iterations());
  const bool tight =
      initialize_certified(graph, rotation_error,
                           std::max(kCertifiedDescents * descent, kLeastCertifiedIterations))
          .tight;
  if (tight && candidates.best().outcome && rotations_agree(graph.poses, candidates.poses()))
    return candidates.take();
  candidates.descend(std::vector<Group>(graph.poses), PoseGraphInitialization::kCertified);
  if (tight) return candidates.take();
  candidates.descend(file_first ? chordal : file, file_first ? PoseGraphInitialization::kChordal
                                                             : PoseGraphInitialization::kFile);
  spanning_tree_initialization(graph);
  candidates.descend_if_new(std::vector<Group>(graph.poses), PoseGraphInitialization::kOdometry);
  if (initialize_incrementally(graph, rotation_error, kReplayDescents * descent))
    candidates.descend(std::vector<Group>(graph.poses), PoseGraphInitialization::kOdometry);
  return candidates.take();
}

}  // namespace

const char* to_string(PoseGraphInitialization initialization) {
  switch (initialization) {
    case PoseGraphInitialization::kAuto:
      return "auto";
    case PoseGraphInitialization::kFile:
      return "file";
    case PoseGraphInitialization::kOdometry:
      return "odometry";
    case PoseGraphInitialization::kChordal:
      return "chordal";
    case PoseGraphInitialization::kCertified:
      return "certified";
  }
  return "";
}

template <class Group>
void set_initialization(PackedGraph<Group>& graph, PoseGraphInitialization initialization,
                        RotationError rotation_error) {
  switch (initialization) {
    case PoseGraphInitialization::kAuto:
    case PoseGraphInitialization::kFile:
      return;
    case PoseGraphInitialization::kOdometry:
      return spanning_tree_initialization(graph);
    case PoseGraphInitialization::kChordal:
      return chordal_initialization(graph, rotation_error);
    case PoseGraphInitialization::kCertified:
      chordal_initialization(graph, rotation_error);
      (void)initialize_certified(graph, rotation_error);
      return;
  }
}

template <class Group>
bool windings_are_settled(const PackedGraph<Group>& graph) {
  const std::vector<Residual> residuals = rotation_residuals(graph);
  const Tree tree(graph, residuals);
  // No statement is possible about rotations that only translations determine.
  const std::vector<char>& anchor = graph.components.anchor;
  if (tree.roots > std::count(anchor.begin(), anchor.end(), 1)) return false;
  // Ratio of the dispersion to the variances of the weights.
  double squares = 0;
  int edges = 0;
  for (const Residual& residual : residuals) {
    if (residual.variance == 0) continue;
    squares += residual.angles.squaredNorm() / residual.variance;
    ++edges;
  }
  const int cycles = edges - (static_cast<int>(graph.poses.size()) - tree.roots);
  if (cycles <= 0) return true;
  constexpr int axes = kSpaceDim<Group> == 2 ? 1 : 3;
  const double factor = squares / (axes * cycles);
  for (std::size_t e = 0; e < residuals.size(); ++e) {
    const auto& from = tree.nodes[graph.edges[e].from];
    const auto& to = tree.nodes[graph.edges[e].to];
    if (residuals[e].variance == 0 || from.edge == static_cast<int>(e) ||
        to.edge == static_cast<int>(e))
      continue;
    // The common part of both paths is not in the cycle; it is counted nevertheless, which is
    // conservative.
    const double variance = factor * (from.variance + to.variance + residuals[e].variance);
    const double sum = (from.angles + residuals[e].angles - to.angles).norm();
    if (2 * std::numbers::pi * (std::numbers::pi - sum) < kLogOdds * variance) return false;
  }
  return true;
}

template <class Group>
InitializedSolution solve_from_initialization(PackedGraph<Group>& graph,
                                              PoseGraphInitialization initialization,
                                              RotationError rotation_error,
                                              LocalSolver<Group>& solver) {
  if (initialization == PoseGraphInitialization::kAuto)
    return solve_automatically(graph, rotation_error, solver);
  set_initialization(graph, initialization, rotation_error);
  const bool certified = initialization == PoseGraphInitialization::kCertified;
  return {certified ? descend_to_the_end(graph, solver) : solver.solve(graph), initialization,
          certified};
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                            \
  template void set_initialization(PackedGraph<Group>&, PoseGraphInitialization, RotationError); \
  template bool windings_are_settled(const PackedGraph<Group>&);                                 \
  template InitializedSolution solve_from_initialization(                                        \
      PackedGraph<Group>&, PoseGraphInitialization, RotationError, LocalSolver<Group>&);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
