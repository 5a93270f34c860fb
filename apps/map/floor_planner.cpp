#include "apps/map/floor_planner.h"

#include <placegraph/pipeline/map/map_floor_plan.h>

namespace placegraph::apps {

FloorPlanner floor_planner() {
  return [](const StoredMap& stored) { return plan_of_map(stored); };
}

}  // namespace placegraph::apps
