#pragma once
#include <placegraph/eval/plots/plot.h>
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph {

/// Contents of the files that `placegraph run` writes.
/// Number of constraints from other sensors, and their deviation from the map.
/// The deviation is the median of |e| in stated standard deviations, per coordinate.
nlohmann::json describe_motion(const PlaceGraph& graph);
/// Members of result.json for the map and its trajectories; the caller adds the times.
nlohmann::json describe_run(const RunResult& run, const Trajectory& optimized);
/// The trajectories, the places with their numbers, and the accepted loops.
/// With `ground_truth` (may be nullptr) it also shows the errors. The notes name the alignment.
Plot run_plot(const Map& map, const Trajectory& optimized, const Trajectory* ground_truth,
              const std::string& title);

}  // namespace placegraph
