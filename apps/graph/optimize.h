#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/options.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/graph/graph_solution.h"
#include "apps/graph/landmark_solution.h"

namespace placegraph::apps {

/// A choice among the options of the backend, by its path: its names and default stand there.
/// Throws ArgumentError if there is none of that path.
OptionEntry pose_graph_option(const std::string& path);

/// The names of the rotation errors, in the order of RotationError.
const std::vector<std::string>& optimize_costs();

struct OptimizeArguments {
  std::string in, out;  ///< graph to read (g2o, TORO or iSAM) and to write (g2o)
  std::string plot;     ///< .png or .svg of the poses before and after; empty: none
  std::string cost = "log";
  std::string engine = pose_graph_option("engine").value;
  std::string start = pose_graph_option("start").value;
  std::string robust = pose_graph_option("robust.method").value;
  GraphTask task;              ///< but what the four names above choose among its options
  bool drop_rejected = false;  ///< `out` is written without rejected constraints
  bool force = false;          ///< overwrite `out` and `plot`
};

/// chi2 of a graph in both conventions, over the constraints that are not left out.
struct GraphCosts {
  double g2o = 0, log = 0;
};

struct OptimizeResult {
  std::string in, out, cost, engine, robust;  ///< as asked
  GraphCosts before, after;
  GraphSolution solution;
  std::optional<LandmarkSolution> landmarks;  ///< in place of the two above: of a graph with some
};

/// `placegraph optimize`: reads a graph, optimizes it and writes it and its plot. What it does goes
/// to `sink`, with a warning where the cost looks like that of a wrong graph. Throws ArgumentError,
/// FileError, and NoAnswer where there is no solution; then nothing is written.
OptimizeResult optimize(const OptimizeArguments& arguments, const LogSink& sink = {});

std::string to_text(const OptimizeResult& result);
std::string to_json(const OptimizeResult& result);

}  // namespace placegraph::apps
