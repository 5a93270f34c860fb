#pragma once
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/io/synthetic/worlds/simulated_flight.h>
#include <placegraph/io/synthetic/worlds/tours.h>

namespace placegraph::synthetic {

/// The data of a flight world beside its images. The scene's axes are rotated from the world's (z
/// up).
struct FlightSetting {
  SimulatedFlight flight;
  MarkerLayout layout;
  SE3 T_body_cam;
  static SE3 T_world_scene();
};

/// A quadrotor over a level floor of several materials with AprilTags and lamps in its middle, with
/// a downward camera (640 x 480, 77 degrees wide, 20 Hz). No tags or lamps are visible away from
/// the middle.
Tour make_flight_world(const TourRequest& request);

}  // namespace placegraph::synthetic
