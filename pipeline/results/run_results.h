#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/pipeline/run.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

// What the folder of a run holds. Texts are members of its result.json; the keys are in
// docs/output.md.

/// The map of a run and its trajectories, JSON.
/// `optimized` is Map::trajectory_optimized() of the run's map.
std::string run_json(const RunResult& run, const Trajectory& optimized);

/// Number of constraints from other sensors and their deviation from the map, JSON.
/// The deviation is the median of |e| in stated standard deviations, per coordinate.
std::string motion_json(const PlaceGraph& graph);

/// The components of a map, JSON: their frames, and the file of the trajectory of each.
std::string components_json(const Map& map);

/// The judgement of a run, JSON: verdict, metric, why_metric and findings.
std::string judgement_json(const Judgement& judgement);

/// What the ground truth says of a run, JSON.
///
/// These are `path_m`, `evaluation` by alignment (origin, se3, sim3), `loop_check` (metric maps
/// only) and `place_check`. `truth` has one pose per frame of the sequence, `optimized` one per
/// frame of the map.
std::string truth_json(const Trajectory& truth, const RunResult& run, const Trajectory& optimized);

/// Writes the trajectories of every component but the main one, whose files have no number.
/// They are `trajectory_optimized.componentN.tum` and `.kitti`; those of an earlier run in this
/// folder are removed. Throws FileError.
void write_other_components(const std::string& folder, const Map& map);

/// The trajectories of a run, the places with their numbers, and the accepted loops; SVG.
///
/// `truth`, which may be null, has a pose for every frame of the recording, T_world_cam; with it
/// the picture also shows the errors. Its notes name the alignment.
std::string run_picture(const Map& map, const Trajectory& optimized, const Trajectory* truth,
                        const std::string& title);

}  // namespace placegraph
