#pragma once
#include <placegraph/eval/alignment/umeyama.h>
#include <placegraph/graph/map.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace placegraph::report {

/// The ground truth of a run's frames, and the alignment of the estimate to it.
struct RunTruth {
  Trajectory of_frames;       ///< T_truth_cam, a pose or none for every frame of the map
  AlignmentResult alignment;  ///< from the map to the ground truth
};

/// The columns of a run's frames: one row for each of Map::frames.
nlohmann::json describe_frames_for_report(const Map& map, const std::optional<RunTruth>& truth);

}  // namespace placegraph::report
