#pragma once
#include <placegraph/eval/internal/trajectory/edge_consistency.h>
#include <placegraph/graph/pose_graph/constraint_source.h>

#include <map>
#include <string>

namespace placegraph::apps {

struct EvalEdgesArguments {
  std::string truth;  ///< true poses of every frame of the sequence, or its folder with poses.txt
  std::string run;    ///< folder that placegraph run has written
};

struct EvalEdgesResult {
  std::map<ConstraintSource, EdgeConsistency> by_source;  ///< of the sources that edges have
};

/// `placegraph eval-edges`: whether the edges of a run's place graph are as sure as they claim.
/// Throws ArgumentError where the truth has too few frames, FileError.
EvalEdgesResult eval_edges(const EvalEdgesArguments& arguments);

/// A table, one row per source.
std::string to_text(const EvalEdgesResult& result);
std::string to_json(const EvalEdgesResult& result);

}  // namespace placegraph::apps
