#pragma once
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Solution of `optimize` for a graph with priors and point landmarks, and its cost in time.
struct LandmarkSolution {
  LandmarkGraph graph;
  std::string engine;  ///< "native" or "ceres"
  int components = 1;
  /// chi2 in g2o's convention; nothing if it is undefined for priors of an offset sensor.
  std::optional<double> chi2_g2o_initial, chi2_g2o;
  double chi2_log_initial = 0, chi2_log = 0;
  int iterations = 0;
  double cpu_ms = 0, wall_ms = 0, peak_mb = 0;
  int free_directions = 0;
  std::vector<NodeId> free_vertices;  ///< ids of poses and points
  std::vector<NodeId> held_vertices;  ///< one vertex of each component without a tie to the world
  int degrees_of_freedom = 0;
  std::vector<Doubt> doubts;  ///< what speaks against the solution
};

/// Optimizes a graph with priors and point landmarks. Throws NoResult if it has no solution.
LandmarkSolution solve_landmarks(LandmarkGraph graph, const PoseGraphOptions& options);

/// Members of the JSON report of `optimize` for this solution.
nlohmann::ordered_json describe(const LandmarkSolution& solution);

/// Text for people.
/// `in` and `out` are the files, `cost` is the convention that was minimized.
std::string to_text(const LandmarkSolution& solution, const std::string& in,
                    const std::string& cost, const std::string& out);

}  // namespace placegraph::apps
