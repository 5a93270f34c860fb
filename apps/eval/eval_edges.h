#pragma once
#include <placegraph/eval/edges/edge_consistency.h>
#include <placegraph/eval/edges/edge_mount.h>
#include <placegraph/graph/pose_graph/constraint_source.h>

#include <map>
#include <optional>
#include <string>

namespace placegraph::apps {

struct EvalEdgesArguments {
  std::string truth;  ///< true poses of every frame of the sequence, or its folder with poses.txt
  std::string run;    ///< folder written by `placegraph run`
  std::string truth_noise = "none";  ///< see truth_noise_of()
  bool fit_mount = false;            ///< fit the camera's pose in the frame of the truth first
};

struct EvalEdgesResult {
  std::map<ConstraintSource, EdgeConsistency> by_source;  ///< for every source that occurs
  std::optional<TruthMount> mount;                        ///< if it was fitted
};

/// Compares edge errors with stated covariances: `placegraph eval edges`.
/// Throws ArgumentError if the truth has not one pose per frame of the run, FileError, NoResult if
/// the graph has no edges or errors are too large to be computed, and as truth_noise_of().
EvalEdgesResult eval_edges(const EvalEdgesArguments& arguments);

/// A table, one row per source, with `axes` one of the errors of every axis, and a verdict per
/// source; that on the odometry is last.
std::string to_text(const EvalEdgesResult& result, bool axes = false);
std::string to_json(const EvalEdgesResult& result);

}  // namespace placegraph::apps
