#pragma once
#include <placegraph/pipeline/internal/flight/flight_run.h>
#include <placegraph/pipeline/internal/flight/marker_map.h>

namespace placegraph {

/// Where the markers of `layout.unplaced_sides_m` are, after a flight: its images are searched
/// again, and `map_markers` is asked with the motions between them as the flight knew them. How
/// sure those are: the flow's covariance over the floor (the velocity's where there was none), the
/// gyro's noise, what is not known of its bias, and what the filter corrected itself by in between.
/// Markers of the layout anchor the map; where none is, the world is the flight's. Throws as the
/// data set does. Outcomes: those of map_markers.
[[nodiscard]] MarkerMap map_flight_markers(const Dataset& images, const FlightRun& run,
                                           const SE3& T_body_cam, const MarkerLayout& layout,
                                           const FlightOptions& options);

}  // namespace placegraph
