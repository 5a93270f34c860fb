#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

#include <functional>

namespace [[gnu::visibility("default")]] placegraph {

/// Makes the plan of a finished map.
///
/// Reads the frames of its keyframes (those that are far enough from each other) with `frame_of`,
/// and fuses them.
[[nodiscard]] FloorPlan map_floor_plan(const Map& map, const Calibration& calibration,
                                       const std::function<Frame(const Keyframe&)>& frame_of,
                                       const FloorPlanMapperOptions& options = {});

}  // namespace placegraph
