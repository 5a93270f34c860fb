#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/graph/scene/true_floor_plan.h>

#include <vector>

namespace placegraph {

struct FloorPlanCheckOptions {
  double range_m = 8;  ///< range of visible surfaces from a pose [m]
  /// Half field of view, to the left and right of the optical axis [deg].
  double half_view_deg = 30;
  double min_incidence_deg = 15;
  double found_m = 0.15;  ///< largest distance of a found wall from an estimated one [m]
  double door_m = 0.3;  ///< largest distance between the middles of a true door and a found one [m]
};

/// A floor plan, compared with the true one.
struct FloorPlanCheck {
  /// Median distance from the visible surfaces of true walls to the nearest wall of the plan with
  /// the same orientation, by length; distances count as at most one metre.
  double truth_to_plan_median_m = 0;
  double truth_found_share = 0;  ///< share of that length within `found_m`
  double seen_length_m = 0;      ///< length of true surfaces visible from the poses
  /// The same from the plan's walls to the nearest true surface.
  double plan_to_truth_median_m = 0;
  double plan_right_share = 0;
  double plan_length_m = 0;
  /// For each true room that was entered: its area compared with the room of the plan that covers
  /// most of it.
  struct RoomCheck {
    std::string name;
    double iou = 0;
    int room = -1;  ///< index of that room of the plan; -1: none
  };
  std::vector<RoomCheck> rooms;
  int doors_seen = 0, doors_found = 0, doors_false = 0;
  int doors_state_right = 0;  ///< found doors with the right state, open or closed
};

/// Compares a floor plan with the true one.
/// `T_truth_plan` maps the plan's (x, y, z) to the truth's; `poses` are the true poses. Rooms
/// without a wall between them are one room; rooms end at the surfaces of the walls. A true door is
/// visible if its middle is visible from a pose, with only walls and closed doors as obstacles.
FloorPlanCheck check_floor_plan(const FloorPlan& plan, const TrueFloorPlan& truth,
                                const SE3& T_truth_plan, const std::vector<SE3>& poses,
                                const FloorPlanCheckOptions& options = {});

}  // namespace placegraph
