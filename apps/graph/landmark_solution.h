#pragma once
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// Optimizes a graph with priors and point landmarks; what the report says of it. Throws NoAnswer
/// where it has no solution.
nlohmann::ordered_json solve_landmarks(LandmarkGraph& graph, const PoseGraphOptions& options);

/// The report in words.
void print_landmarks(const nlohmann::ordered_json& report);

}  // namespace placegraph::apps
