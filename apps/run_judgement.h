#pragma once
#include <placegraph/graph/core/trajectory.h>
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph::apps {

/// What result.json says of a run whose sequence knows the truth: `path_m`, `evaluation` by
/// alignment (origin, se3, sim3), `loop_check` (metric maps only) and `place_check`. `truth` has
/// one pose per frame of the sequence, `optimized` one per frame of the map.
nlohmann::json judge_run(const Trajectory& truth, const RunResult& run,
                         const Trajectory& optimized);

/// The truth of the frames that were run.
Trajectory truth_of_frames(const Trajectory& truth, const Map& map);

}  // namespace placegraph::apps
