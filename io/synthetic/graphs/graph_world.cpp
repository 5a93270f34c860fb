#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace placegraph::synthetic {
namespace {

void require_field(bool holds, const char* field, const char* what) {
  if (!holds) throw ArgumentError(std::string(field) + ": " + what);
}

constexpr int kMaxPoses = 1000000;

void check_poses(int poses, int min) {
  if (poses < min || poses > kMaxPoses)
    throw ArgumentError("poses: must be from " + std::to_string(min) + " to " +
                        std::to_string(kMaxPoses));
}

template <class Group>
constexpr int kDim = Group::kDof == 3 ? 2 : 3;

template <class Group>
Group noise_of(const GraphNoise& noise, Random& random) {
  typename Group::Tangent xi;
  for (int i = 0; i < Group::kDof; ++i)
    xi[i] = random.normal(0, i < kDim<Group> ? noise.translation_m : noise.rotation_rad);
  return Group::exp(xi);
}

/// Poses of a walk and the measured pairs; `finish` makes a graph of them.
template <class Group>
struct Truth {
  std::vector<Group> T_world_node;
  std::vector<std::array<int, 2>> loops;
};

template <class Group>
PoseGraph finish(const Truth<Group>& truth, const GraphNoise& noise, Random& random) {
  PoseGraph graph;
  Information information = Information::Zero(Group::kDof, Group::kDof);
  for (int i = 0; i < Group::kDof; ++i)
    information(i, i) = 1 / std::pow(i < kDim<Group> ? noise.translation_m : noise.rotation_rad, 2);
  const auto measure = [&](int from, int to, ConstraintSource source) {
    const Group T_from_to = truth.T_world_node[from].inverse() * truth.T_world_node[to] *
                            noise_of<Group>(noise, random);
    graph.constraints.emplace_back(
        RelativePoseConstraint{NodeId(from), NodeId(to), T_from_to, information, source, {}});
  };
  for (std::size_t i = 0; i < truth.T_world_node.size(); ++i) {
    graph.nodes.push_back({NodeId(i), truth.T_world_node[i], false});
    if (i > 0) measure(static_cast<int>(i) - 1, static_cast<int>(i), ConstraintSource::kOdometry);
  }
  for (const auto& [from, to] : truth.loops) measure(from, to, ConstraintSource::kLoop);
  integrate_odometry(graph);
  return graph;
}

/// A pose of the closed course of length `length_m` at the polar angle `angle_rad`: an ellipse with
/// three dents; in space it also goes up and down.
template <class Group>
Group pose_on_route(double angle_rad, double length_m) {
  const double r = length_m / (2 * std::numbers::pi);
  const auto point = [&](double a) {
    const double s = r * (1 + 0.15 * std::cos(3 * a));
    return Eigen::Vector3d(1.2 * s * std::cos(a), 0.8 * s * std::sin(a),
                           0.05 * r * std::sin(2 * a));
  };
  const Eigen::Vector3d position = point(angle_rad);
  const Eigen::Vector3d ahead = point(angle_rad + 1e-4) - position;
  const double yaw = std::atan2(ahead[1], ahead[0]);
  if constexpr (Group::kDof == 3) {
    return SE2(position[0], position[1], yaw);
  } else {
    const double pitch = -std::atan2(ahead[2], ahead.head<2>().norm());
    return SE3(SO3::exp({0, 0, yaw}) * SO3::exp({0, pitch, 0}), position);
  }
}

template <class Group>
PoseGraph long_loop(const LongLoopOptions& options) {
  Random random(options.seed);
  Truth<Group> truth;
  const double lap = options.poses / options.laps;
  for (int i = 0; i < options.poses; ++i)
    truth.T_world_node.push_back(pose_on_route<Group>(2 * std::numbers::pi * i / lap, lap));
  const int before = static_cast<int>(std::ceil(lap));
  for (int k = 0; k < options.closures; ++k) {
    const int share = static_cast<int>((k + 0.5) * (options.poses - before) / options.closures);
    const int to = before + share;
    truth.loops.push_back({static_cast<int>(std::lround(to - lap)), to});
  }
  return finish(truth, options.noise, random);
}

template <class Group>
void disturb_odometry_rotations(PoseGraph& graph, double sigma_rad, Random& random) {
  for (Constraint& constraint : graph.constraints) {
    auto* relative = std::get_if<RelativePoseConstraint>(&constraint);
    if (!relative || relative->source != ConstraintSource::kOdometry) continue;
    relative->T_from_to =
        std::get<Group>(relative->T_from_to) * noise_of<Group>({0, sigma_rad}, random);
  }
}

}  // namespace

void GraphNoise::check() const {
  const auto fits = [](double sigma) { return sigma >= 1e-9 && sigma <= 1e9; };
  require_field(fits(translation_m), "noise.translation_m", "must lie in [1e-9, 1e9]");
  require_field(fits(rotation_rad), "noise.rotation_rad", "must lie in [1e-9, 1e9]");
}

void ManhattanWalkOptions::check() const {
  check_poses(poses, 2);
  require_field(block_m >= 1, "block_m", "must be at least 1");
  require_field(side_blocks >= 0, "side_blocks", "must not be negative");
  require_field(loop_share >= 0 && loop_share <= 1, "loop_share", "must lie in [0, 1]");
  noise.check();
}

void GridWorldOptions::check() const {
  check_poses(poses, 2);
  require_field(loop_share >= 0 && loop_share <= 1, "loop_share", "must lie in [0, 1]");
  noise.check();
}

void LongLoopOptions::check() const {
  check_poses(poses, 10);
  require_field(laps > 1 && laps <= poses, "laps", "must be more than 1 and at most one a pose");
  require_field(closures >= 1, "closures", "must be at least 1");
  require_field(closures <= poses - std::ceil(poses / laps), "closures",
                "more than poses of the repeated part");
  require_field(kind != PoseKind::kSim3, "kind", "must be SE2 or SE3");
  noise.check();
}

PoseGraph make_manhattan_walk(const ManhattanWalkOptions& options) {
  options.check();
  Random random(options.seed);
  // There are 2 * side * (side + 1) streets of block_m metres, each walked about twice.
  const int side =
      options.side_blocks > 0
          ? options.side_blocks
          : std::max(
                1, static_cast<int>(std::lround(std::sqrt(options.poses / 4.0 / options.block_m))));
  const int side_m = side * options.block_m;
  const std::array<std::array<int, 2>, 4> step = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  Truth<SE2> truth;
  std::unordered_map<std::int64_t, int> oldest;  // pose at a point of the grid
  int x = side / 2 * options.block_m, y = x, heading = 0;
  for (int i = 0; i < options.poses; ++i) {
    if (x % options.block_m == 0 && y % options.block_m == 0) {
      const auto leaves_town = [&](int h) {
        const int to_x = x + step[h][0], to_y = y + step[h][1];
        return to_x < 0 || to_y < 0 || to_x > side_m || to_y > side_m;
      };
      int next;
      do {
        next = (heading + 3 + random.index(3)) % 4;  // right, straight on, left
      } while (leaves_town(next));
      heading = next;
    }
    truth.T_world_node.emplace_back(x, y, heading * std::numbers::pi / 2);
    const std::int64_t here = static_cast<std::int64_t>(y) * (side_m + 1) + x;
    const auto [found, fresh] = oldest.emplace(here, i);
    if (!fresh && random.uniform() < options.loop_share) truth.loops.push_back({found->second, i});
    x += step[heading][0];
    y += step[heading][1];
  }
  return finish(truth, options.noise, random);
}

PoseGraph make_grid_world(const GridWorldOptions& options) {
  options.check();
  Random random(options.seed);
  const int side =
      std::max(2, static_cast<int>(std::ceil(std::cbrt(static_cast<double>(options.poses)))));
  Truth<SE3> truth;
  std::unordered_map<std::int64_t, int> at;  // pose in a cell
  SO3 R_world_node;
  for (int i = 0; i < options.poses; ++i) {
    const int z = i / (side * side), in_layer = i % (side * side);
    int y = in_layer / side, x = in_layer % side;
    if (z % 2 == 1) y = side - 1 - y;
    if ((i / side) % 2 == 1) x = side - 1 - x;
    R_world_node = R_world_node *
                   SO3::exp({random.normal(0, 0.3), random.normal(0, 0.3), random.normal(0, 0.3)});
    truth.T_world_node.emplace_back(R_world_node, Eigen::Vector3d(x, y, z));
    const auto cell = [&](int cx, int cy, int cz) {
      return (static_cast<std::int64_t>(cz) * side + cy) * side + cx;
    };
    at.emplace(cell(x, y, z), i);
    for (const std::array<int, 3>& neighbour :
         {std::array{x, y - 1, z}, std::array{x, y + 1, z}, std::array{x, y, z - 1}}) {
      if (*std::min_element(neighbour.begin(), neighbour.end()) < 0 || neighbour[1] >= side)
        continue;
      const auto found = at.find(cell(neighbour[0], neighbour[1], neighbour[2]));
      if (found == at.end() || found->second >= i - 1 || random.uniform() >= options.loop_share)
        continue;
      truth.loops.push_back({found->second, i});
    }
  }
  return finish(truth, options.noise, random);
}

PoseGraph make_long_loop(const LongLoopOptions& options) {
  options.check();
  return options.kind == PoseKind::kSE2 ? long_loop<SE2>(options) : long_loop<SE3>(options);
}

void add_rotation_noise(PoseGraph& graph, double sigma_rad, std::uint64_t seed) {
  require_field(sigma_rad >= 0 && sigma_rad <= 1e9, "sigma_rad", "must lie in [0, 1e9]");
  require_field(graph.kind() != PoseKind::kSim3, "graph", "must be SE2 or SE3");
  Random random(seed);
  if (graph.kind() == PoseKind::kSE2)
    disturb_odometry_rotations<SE2>(graph, sigma_rad, random);
  else
    disturb_odometry_rotations<SE3>(graph, sigma_rad, random);
  integrate_odometry(graph);
}

void disturb_poses(PoseGraph& graph, double extent_m, std::uint64_t seed) {
  Random random(seed);
  for (PoseNode& node : graph.nodes) {
    Eigen::Vector3d position;
    for (int i = 0; i < 3; ++i) position[i] = extent_m * random.uniform(-0.5, 0.5);
    Eigen::Quaterniond q;
    do {
      for (int i = 0; i < 4; ++i) q.coeffs()[i] = random.normal();
    } while (q.norm() < 1e-3);
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    if (node.fixed) continue;
    if (graph.kind() == PoseKind::kSE2)
      node.T_world_node = SE2(position[0], position[1], angle);
    else if (graph.kind() == PoseKind::kSE3)
      node.T_world_node = SE3(SO3(q), position);
    else
      node.T_world_node = Sim3(SO3(q), position, 1);
  }
}

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
