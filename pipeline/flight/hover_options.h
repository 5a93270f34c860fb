#pragma once
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/flight/floor_flow.h>
#include <placegraph/pipeline/flight/marker_map.h>
#include <placegraph/pipeline/flight/marker_sensor.h>
#include <placegraph/pipeline/flight/start_state.h>

namespace placegraph {

/// Options of `placegraph hover`: of FlightEstimator and of `map_hover_markers`. The keys of `flow`
/// and `marker_sensor` are not in groups of their own.
struct HoverOptions {
  double floor_z_m = 0;  ///< height of the level floor in the world
  FloorFlowOptions flow;
  /// A pose by markers comes so much later than its image, as where another computer finds it.
  double marker_delay_s = 0;
  MarkerSensorOptions marker_sensor;
  HoverStartOptions start;
  PositionFilterOptions filter;
  double map_interval_s = 0.2;  ///< of `map_hover_markers`, between images that are searched whole
  MarkerMapOptions map;         ///< of the same
  void check() const;
};
void visit(OptionVisitor& field, HoverOptions& options);

}  // namespace placegraph
