#pragma once
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/loops/keyframe_motion.h>
#include <placegraph/pipeline/loops/loop_options.h>

namespace placegraph {

// Tests that reject false loops. All lengths are in the query's scale unless stated otherwise;
// `median_depth_m` is that of the scene at the query.

/// Possible error of the relative pose of two keyframes beyond all covariances.
struct Drift {
  double length;
  double angle_rad;
  double log_scale;
};

/// Drift grows with the path length between two keyframes; a heading error bends the path itself,
/// by half the angle at `distance`, the straight-line distance between them. The angle is at most
/// pi.
Drift drift_over(double path_length, double distance, double median_depth_m,
                 const LoopOptions& options);

/// Whether two keyframes can be so close to each other, given the possible drift of `odometry`
/// (T_match_query), that a verified loop could be within_drift. `farthest` is the greatest depth of
/// the match's features: the verifier accepts baselines up to a share of it.
bool within_reach(const TrackedMotion& odometry, double farthest, double median_depth_m,
                  const LoopOptions& options);

/// Whether the difference between the loop and `odometry` (T_match_query) can be drift. With
/// `free_scale` the scale may also have drifted, by the amount given by the loop.
bool within_drift(const Loop& loop, const TrackedMotion& odometry, double median_depth_m,
                  bool free_scale, const LoopOptions& options);

/// Whether the loop is consistent with the map: squared Mahalanobis distance of `predicted`
/// (S_match_query) with its marginal covariance, the covariance of the loop, and the possible drift
/// along the shortest path between the keyframes, loops included; 6 degrees of freedom at 99.9 %. A
/// loop that leaves a direction unobservable passes.
bool within_covariance(const Loop& loop, const PredictedMotion& predicted, double median_depth_m,
                       const LoopOptions& options);

/// Whether two loops agree on the relative pose of two stretches of the trajectory. `queries` is
/// the odometry from the query of `a` to that of `b`, `matches` the same for the matches.
bool agree(const Loop& a, const Loop& b, const TrackedMotion& queries, const TrackedMotion& matches,
           double median_depth_m);

}  // namespace placegraph
