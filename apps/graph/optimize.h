#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/options.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/graph/graph_solution.h"
#include "apps/graph/landmark_solution.h"

namespace placegraph::apps {

/// Option of the backend with the given path, with its names and its default.
/// Throws ArgumentError if there is none.
OptionEntry pose_graph_option(const std::string& path);

/// Names of the rotation errors, in the order of RotationError.
const std::vector<std::string>& optimize_costs();

struct OptimizeArguments {
  std::string in, out;  ///< graph to read (g2o, TORO or iSAM) and to write (g2o)
  /// .csv of the covariances of the optimized poses; empty: none
  std::string covariances;
  std::string plot;    ///< .png or .svg of the poses before and after; empty: none
  std::string report;  ///< page that shows the graph, which the caller writes; empty: none
  std::string cost = "log";
  std::string engine = pose_graph_option("engine").value;
  std::string initialization = pose_graph_option("initialization").value;
  std::string robust = pose_graph_option("robust.method").value;
  std::string indefinite = "refuse";  ///< of indefinite_information_names()
  GraphTask task;                     ///< its options with a name above are set by that name
  bool drop_rejected = false;         ///< leave rejected constraints out of `out`
  bool force = false;                 ///< overwrite the files above
};

/// chi2 of a graph in both conventions, over the constraints that were not rejected.
struct GraphCosts {
  double g2o = 0, log = 0;
};

struct OptimizeResult {
  std::string in, out, cost, engine, robust;  ///< as in the arguments
  GraphCosts before, after;
  GraphSolution solution;
  int replaced = 0;  ///< edges whose information was indefinite and was replaced
  PoseGraph start;   ///< the graph as it was read, if a report is asked for
  std::optional<LandmarkSolution>
      landmarks;  ///< replaces `before`, `after` and `solution` for a graph with landmarks
};

/// Reads a graph, optimizes it, and writes it and its plot: `placegraph graph optimize`.
/// Progress goes to `sink`, with a warning if the cost looks like that of a wrong graph. Throws
/// ArgumentError, FileError, and NoResult if there is no solution; then nothing is written.
OptimizeResult optimize(const OptimizeArguments& arguments, const LogSink& sink = {});

std::string to_text(const OptimizeResult& result);
std::string to_json(const OptimizeResult& result);

}  // namespace placegraph::apps
