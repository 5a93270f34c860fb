#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph::synthetic {

/// Noise of the measured poses of a synthetic graph: normal, independent in every direction. The
/// information is its inverse, so chi2 at the truth is about the number of measured directions.
struct GraphNoise {
  double translation_m = 0.02;
  double rotation_rad = 0.01;
  void check() const;
};

/// A walk along the streets of a square grid in the plane, one pose per metre. At every corner it
/// continues straight on, left or right at random and stays inside the town. A pose within a metre
/// of older ones is joined to the oldest of them with the probability `loop_share`.
struct ManhattanWalkOptions {
  int poses = 3500;
  int block_m = 5;  ///< distance between two corners [m]
  /// Blocks per side of the town; 0: such that every street has about two visits.
  int side_blocks = 0;
  double loop_share = 0.5;
  GraphNoise noise = {};
  std::uint64_t seed = 1;
  void check() const;
};
/// Makes an SE(2) graph; the initial values are the integrated odometry.
PoseGraph make_manhattan_walk(const ManhattanWalkOptions& options);

/// A path through every cell of a cube of one-metre cells, row by row and layer by layer, back and
/// forth, with a rotation of the pose at every step. Every cell is joined to its neighbour in the
/// previous row and in the previous layer with the probability `loop_share`.
struct GridWorldOptions {
  int poses = 1000;
  double loop_share = 0.5;
  GraphNoise noise = {};
  std::uint64_t seed = 1;
  void check() const;
};
/// Makes an SE(3) graph; the initial values are the integrated odometry.
PoseGraph make_grid_world(const GridWorldOptions& options);

/// A closed bent course that is driven `laps` times, one pose per metre; `closures` loops, evenly
/// spread over the repeated part, join a pose to the one a lap before.
struct LongLoopOptions {
  int poses = 2000;
  double laps = 1.1;
  int closures = 20;
  PoseKind kind = PoseKind::kSE2;  ///< SE2 or SE3
  GraphNoise noise = {};
  std::uint64_t seed = 1;
  void check() const;
};
/// Makes the graph; the initial values are the integrated odometry.
PoseGraph make_long_loop(const LongLoopOptions& options);

/// Adds a normal rotation of `sigma_rad` about every axis to every odometry measurement of SE(2) or
/// SE(3) and integrates the initial values from them again. The information does not change.
void add_rotation_noise(PoseGraph& graph, double sigma_rad, std::uint64_t seed);

/// Sets every pose that is not fixed to a random one: position uniform in a cube (square) of the
/// side `extent_m`, rotation uniform.
void disturb_poses(PoseGraph& graph, double extent_m, std::uint64_t seed);

}  // namespace placegraph::synthetic
