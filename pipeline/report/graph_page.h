#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A pose graph before and after its optimization.
struct GraphPage {
  std::string name;           ///< name of the graph
  PoseGraph before;           ///< as it was read
  PoseGraph after;            ///< the optimized one, with the same nodes and constraints
  std::vector<double> chi2;   ///< one for every constraint, at the solution; empty: unknown
  std::vector<int> rejected;  ///< positions of the constraints that were rejected
  std::vector<std::pair<std::string, double>> figures;  ///< names and values of costs
};

/// A page, HTML, that shows the graph; `program`: name and version of the program.
std::string graph_page(const GraphPage& graph, const std::string& program);

/// Writes that page, as `placegraph graph optimize --report` does.
/// Throws FileError if it cannot be written.
void write_graph_page(const std::string& file, const GraphPage& graph, const std::string& program);

}  // namespace placegraph
