#pragma once
#include <placegraph/graph/geometry/trajectory.h>
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

/// T_truth_map of an estimate with one pose per frame of the map: by the first frame that has both
/// poses, and as fits all positions best (umeyama, no scale). Identity where nothing says it.
SE3 fit_by_first_pose(const Trajectory& truth, const Map& map, const Trajectory& estimate);
SE3 fit_by_positions(const Trajectory& truth, const Map& map, const Trajectory& estimate);

}  // namespace placegraph::apps
