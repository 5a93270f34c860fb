#pragma once
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// What `placegraph run` leaves in its folder, as the contents of files.
std::string places_json(const Map& map);
std::string loops_csv(const Map& map);  ///< query,match,inliers,accepted,stage
/// How many constraints of the place graph came from other sensors, and how far they lie from the
/// map: median of |e| in claimed standard deviations, per coordinate.
nlohmann::json describe_motion(const PlaceGraph& graph);
/// Everything result.json says of the map and its trajectories; times are the caller's.
nlohmann::json describe_run(const RunResult& run, const Trajectory& optimized);
/// Top view of the trajectories and the places, loops as links, errors if the truth of the sequence
/// is known (else nullptr); PNG bytes.
std::string run_plot(const RunResult& run, const Trajectory& optimized,
                     const Trajectory* ground_truth, const std::string& title);

}  // namespace placegraph::apps
