#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {
namespace synthetic {

/// Noise of the measured poses of a synthetic graph: normal, independent in every direction.
///
/// The information is its inverse, so chi2 at the truth is about the number of measured directions.
struct GraphNoise {
  double translation_m = 0.02;  ///< standard deviation of a coordinate [m]
  double rotation_rad = 0.01;   ///< standard deviation about an axis [rad]
  void check() const;           ///< throws ArgumentError naming the field
};

/// A walk along the streets of a square grid in the plane, one pose per metre.
///
/// At every corner it continues straight on, left or right at random and stays inside the town. A
/// pose within a metre of older ones is joined to the oldest of them with the probability
/// `loop_share`.
struct ManhattanWalkOptions {
  int poses = 3500;  ///< number of poses
  int block_m = 5;   ///< distance between two corners [m]
  /// Blocks per side of the town; 0: such that every street has about two visits.
  int side_blocks = 0;
  double loop_share = 0.5;  ///< probability of a loop where one is possible
  GraphNoise noise = {};    ///< noise of the measurements
  std::uint64_t seed = 1;   ///< another seed gives another graph
  void check() const;       ///< throws ArgumentError naming the field
};
/// Makes an SE(2) graph; the initial values are the integrated odometry.
PoseGraph make_manhattan_walk(const ManhattanWalkOptions& options);

/// A path through every cell of a cube of one-metre cells, back and forth.
///
/// It goes row by row and layer by layer, with a rotation of the pose at every step. Every cell is
/// joined to its neighbour in the previous row and in the previous layer with the probability
/// `loop_share`.
struct GridWorldOptions {
  int poses = 1000;         ///< number of poses, one per cell
  double loop_share = 0.5;  ///< probability of a loop where one is possible
  GraphNoise noise = {};    ///< noise of the measurements
  std::uint64_t seed = 1;   ///< another seed gives another graph
  void check() const;       ///< throws ArgumentError naming the field
};
/// Makes an SE(3) graph; the initial values are the integrated odometry.
PoseGraph make_grid_world(const GridWorldOptions& options);

/// A closed bent course that is driven `laps` times, one pose per metre.
///
/// `closures` loops, evenly spread over the repeated part, join a pose to the one a lap before.
struct LongLoopOptions {
  int poses = 2000;                ///< number of poses
  double laps = 1.1;               ///< number of times the course is driven
  int closures = 20;               ///< number of loops
  PoseKind kind = PoseKind::kSE2;  ///< SE2 or SE3
  GraphNoise noise = {};           ///< noise of the measurements
  std::uint64_t seed = 1;          ///< another seed gives another graph
  void check() const;              ///< throws ArgumentError naming the field
};
/// Makes the graph; the initial values are the integrated odometry.
PoseGraph make_long_loop(const LongLoopOptions& options);

/// Adds a normal rotation of `sigma_rad` about every axis to every odometry measurement.
///
/// Initial values of SE(2) or SE(3) are integrated from them again. The information does not
/// change.
void add_rotation_noise(PoseGraph& graph, double sigma_rad, std::uint64_t seed);

/// Sets every pose that is not fixed to a random one.
///
/// Its position is uniform in a cube (square) of the side `extent_m`, its rotation uniform.
void disturb_poses(PoseGraph& graph, double extent_m, std::uint64_t seed);

/// Appends `count` false loops, as between places of similar appearance.
///
/// Each has the measurement and the information of a loop of the graph drawn at random, but joins
/// two poses drawn at random that are more than a tenth of the map's diagonal apart. If the poses
/// are drifted odometry, poses that are apart there may be close in truth: optimize them first.
/// Throws ArgumentError: a negative count or one above a million, a graph without loops, poses of
/// which hardly any two are that far apart.
void add_false_loops(PoseGraph& graph, int count, std::uint64_t seed);

/// Shuffles the constraints.
void shuffle_constraints(PoseGraph& graph, std::uint64_t seed);

}  // namespace synthetic
}  // namespace placegraph
