#pragma once
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/internal/loops/keyframe_motion.h>
#include <placegraph/pipeline/loops/loop_options.h>

namespace placegraph {

// Tests that keep false loops out of the map. All lengths are in the query's unit unless said
// otherwise; `median_depth_m` is that of the scene at the query.

/// How far off the relative pose of two keyframes may be by errors that no covariance knows.
struct Drift {
  double length;
  double angle_rad;
  double log_scale;
};

/// Grows with the length of the path between two keyframes; a wrong heading bends the path itself,
/// by half the angle at `distance`, the length of the straight line between them. The angle is at
/// most pi.
Drift drift_over(double path_length, double distance, double median_depth_m,
                 const LoopOptions& options);

/// Whether two keyframes can be so near to each other, by what `odometry` (T_match_query) may have
/// drifted, that a verified loop could be within_drift. `farthest` is the greatest depth of the
/// match's features: the verifier accepts baselines up to a share of it.
bool within_reach(const TrackedMotion& odometry, double farthest, double median_depth_m,
                  const LoopOptions& options);

/// Whether `odometry` (T_match_query) can have drifted from the loop to where it says it is. With
/// `free_scale` the scale may have drifted too, by as much as the loop says.
bool within_drift(const Loop& loop, const TrackedMotion& odometry, double median_depth_m,
                  bool free_scale, const LoopOptions& options);

/// Whether the map, as sure as it is of itself, can have its places where the loop says: squared
/// Mahalanobis distance of `predicted` (S_match_query) by its marginal covariance, the loop's own,
/// and what may have drifted along the shortest path that the map knows between them, loops
/// included; 6 degrees of freedom at 99.9 %. A loop that leaves a direction open passes.
bool within_covariance(const Loop& loop, const PredictedMotion& predicted, double median_depth_m,
                       const LoopOptions& options);

/// Whether two loops say the same of how two stretches of the trajectory lie to each other.
/// `queries` is the odometry from the query of `a` to that of `b`, `matches` the same of the
/// matches.
bool agree(const Loop& a, const Loop& b, const TrackedMotion& queries, const TrackedMotion& matches,
           double median_depth_m, const LoopOptions& options);

}  // namespace placegraph
