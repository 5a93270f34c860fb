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

/// The picture of an optimized pose graph over what it was before, SVG.
///
/// Both graphs have the same nodes and constraints; `rejected` are positions among the constraints,
/// `notes` lines below the title.
std::string graph_picture(const PoseGraph& before, const PoseGraph& after,
                          const std::vector<int>& rejected, const std::string& title,
                          const std::vector<std::string>& notes = {});
/// The same of the graph alone.
std::string graph_picture(const PoseGraph& graph, const std::vector<int>& rejected,
                          const std::string& title);

/// A page, HTML, that shows the graph; `program`: name and version of the program.
std::string graph_page(const GraphPage& graph, const std::string& program);

/// Writes that page, as `placegraph graph optimize --report` does.
/// Throws FileError if it cannot be written.
void write_graph_page(const std::string& file, const GraphPage& graph, const std::string& program);

}  // namespace placegraph
