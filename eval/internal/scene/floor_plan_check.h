#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/internal/scene/building_plan.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <vector>

namespace placegraph {

struct FloorPlanCheckOptions {
  double range_m = 8;         ///< of what a pose can have seen
  double half_view_deg = 30;  ///< to the left and right of its optical axis
  double min_incidence_deg = 15;
  double found_m = 0.15;  ///< a wall as near as that to an estimated one is found
  double door_m = 0.3;    ///< between the middles of a true door and the one found
};

/// A floor plan against the true one.
struct FloorPlanCheck {
  /// Median distance from the visible surfaces of true walls to the nearest wall of the plan that
  /// faces the same way, over their length; what has none within a metre counts as a metre.
  double truth_to_plan_median_m = 0;
  double truth_found_share = 0;  ///< of that length, within `found_m`
  double seen_length_m = 0;      ///< of true surfaces that the poses can have seen
  /// The same from the plan's walls to the nearest true surface.
  double plan_to_truth_median_m = 0;
  double plan_right_share = 0;
  double plan_length_m = 0;
  /// Of each true room that was entered: its surface against the room of the plan that covers most.
  struct RoomCheck {
    std::string name;
    double iou = 0;
    int room = -1;  ///< of the plan
  };
  std::vector<RoomCheck> rooms;
  int doors_seen = 0, doors_found = 0, doors_false = 0;
  int doors_state_right = 0;  ///< found ones, open or closed as they are
};

/// `T_truth_plan` leads from the plan's (x, y, z) to the truth's; `poses` are the true ones. Rooms
/// that no wall parts are one; they end at the surfaces of the walls. A true door is seen if a pose
/// can have seen its middle, with nothing but walls and closed doors in the way.
FloorPlanCheck check_floor_plan(const IndoorMap& plan, const BuildingPlan& truth,
                                const SE3& T_truth_plan, const std::vector<SE3>& poses,
                                const FloorPlanCheckOptions& options = {});

}  // namespace placegraph
