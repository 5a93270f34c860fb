#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph {

/// Members of result.json for a run with ground truth.
/// These are `path_m`, `evaluation` by alignment (origin, se3, sim3), `loop_check` (metric maps
/// only) and `place_check`. `truth` has one pose per frame of the sequence, `optimized` one per
/// frame of the map.
nlohmann::json judge_run(const Trajectory& truth, const RunResult& run,
                         const Trajectory& optimized);

/// True poses of the frames of the run.
Trajectory truth_of_frames(const Trajectory& truth, const Map& map);

/// T_truth_map of an estimate with one pose per frame of the map.
/// The first uses the first frame with both poses, the second fits all positions (umeyama, no
/// scale). Both return the identity without such frames.
SE3 fit_by_first_pose(const Trajectory& truth, const Map& map, const Trajectory& estimate);
SE3 fit_by_positions(const Trajectory& truth, const Map& map, const Trajectory& estimate);

}  // namespace placegraph
