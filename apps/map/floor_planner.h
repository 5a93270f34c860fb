#pragma once
#include <placegraph/pipeline/exports/map_export.h>

namespace placegraph::apps {

/// Makes floor plans for `map export --walls`; empty in a program without placegraph::elements.
FloorPlanner floor_planner();

}  // namespace placegraph::apps
