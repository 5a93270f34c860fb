#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph::synthetic {

/// Noise of the measured poses of a made graph: normal, independent in every direction. The
/// information is its inverse, so chi2 at the truth is about the number of measured directions.
struct GraphNoise {
  double translation_m = 0.02;
  double rotation_rad = 0.01;
  void check() const;
};

/// A walk along the streets of a square grid in the plane, one pose a metre: at every corner it
/// goes straight on, left or right by chance and stays inside the town. A pose that comes within a
/// metre of older ones is joined to the oldest of them with the chance `loop_share`.
struct ManhattanWalkOptions {
  int poses = 3500;
  int block_m = 5;      ///< between two corners
  int side_blocks = 0;  ///< of the town; 0: as many as give about two visits of every street
  double loop_share = 0.5;
  GraphNoise noise = {};
  std::uint64_t seed = 1;
  void check() const;
};
/// SE(2); the start is the integrated odometry.
PoseGraph make_manhattan_walk(const ManhattanWalkOptions& options);

/// A way through every cell of a cube of cells a metre wide, row by row and layer by layer, there
/// and back, with a turn of the pose at every step; every cell is joined to the neighbour of the
/// row before and of the layer before with the chance `loop_share`.
struct GridWorldOptions {
  int poses = 1000;
  double loop_share = 0.5;
  GraphNoise noise = {};
  std::uint64_t seed = 1;
  void check() const;
};
/// SE(3); the start is the integrated odometry.
PoseGraph make_grid_world(const GridWorldOptions& options);

/// A bent round course that is driven `laps` times, one pose a metre; `closures` loops, evenly
/// spread over what is driven again, join a pose to the one a lap before.
struct LongLoopOptions {
  int poses = 2000;
  double laps = 1.1;
  int closures = 20;
  PoseKind kind = PoseKind::kSE2;  ///< SE2 or SE3
  GraphNoise noise = {};
  std::uint64_t seed = 1;
  void check() const;
};
/// The start is the integrated odometry.
PoseGraph make_long_loop(const LongLoopOptions& options);

/// Turns every odometry measurement of SE(2) or SE(3) further by a normal rotation of `sigma_rad`
/// about every axis and integrates the start from them anew. The information stays as it is.
void add_rotation_noise(PoseGraph& graph, double sigma_rad, std::uint64_t seed);

/// Sets every pose that is not fixed to one drawn at random: position uniform in a cube (square) of
/// the side `extent_m`, rotation uniform.
void scatter_poses(PoseGraph& graph, double extent_m, std::uint64_t seed);

}  // namespace placegraph::synthetic
