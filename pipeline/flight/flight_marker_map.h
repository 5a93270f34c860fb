#pragma once
#include <placegraph/pipeline/flight/flight_run.h>
#include <placegraph/pipeline/flight/marker_map.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Maps the markers of `layout.unplaced_sides_m` after a flight: its images are searched again, and
/// `map_markers` is called with the estimated motions between them. The uncertainty of the motions
/// consists of the flow's covariance over the floor (the velocity's where there was no flow), the
/// gyro's noise, the uncertainty of its bias, and the filter's corrections in between. Markers of
/// the layout anchor the map; without such a marker, the world frame is that of the flight. Throws
/// as the data set does. Outcomes: those of map_markers.
[[nodiscard]] MarkerMap map_flight_markers(const Dataset& images, const FlightRun& run,
                                           const SE3& T_body_cam, const MarkerLayout& layout,
                                           const FlightOptions& options);

}  // namespace placegraph
