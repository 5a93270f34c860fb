#pragma once
#include <placegraph/eval/internal/trajectory/edge_consistency.h>
#include <placegraph/graph/pose_graph/constraint_source.h>

#include <map>
#include <string>

namespace placegraph::apps {

struct EvalEdgesArguments {
  std::string truth;  ///< true poses of every frame of the sequence, or its folder with poses.txt
  std::string run;    ///< folder written by `placegraph run`
};

struct EvalEdgesResult {
  std::map<ConstraintSource, EdgeConsistency>
      by_source;  ///< edge consistency of every source that occurs
};

/// Compares edge errors with stated covariances: `placegraph eval edges`.
/// Throws ArgumentError if the truth has too few frames, FileError.
EvalEdgesResult eval_edges(const EvalEdgesArguments& arguments);

/// A table, one row per source.
std::string to_text(const EvalEdgesResult& result);
std::string to_json(const EvalEdgesResult& result);

}  // namespace placegraph::apps
