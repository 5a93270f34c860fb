#pragma once
#include <placegraph/backend/inertial/inertial_options.h>
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/markers/marker_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Measurement of the flow over the floor.
struct FloorFlowOptions {
  double noise_px = 0.05;  ///< standard deviation of a tracked point, beyond the noise of the image
  /// Error common to all flow vectors of an image pair [px]. Chosen so that the drift over seconds
  /// above rendered floors is covered; the dispersion of the vectors would show only a fraction of
  /// it.
  double common_px = 0.025;
  int min_points = 12;  ///< minimum number of inliers for a measurement
  bool enabled = true;  ///< whether flow is used as a measurement
  /// Weak corners are tracked too, because they are weighted by their covariance; steps are not
  /// compared with the first patch of a track. In `FlightOptions` a group of its own, which
  /// `PointTracker` checks.
  PointTrackerOptions tracker{.max_tracks = 120,
                              .window_px = 15,
                              .pyramid_levels = 4,
                              .min_eigenvalue = 1e-4,
                              .max_anchor_shift_px = 0};
};
/// All options except `tracker`.
void visit(OptionVisitor& field, FloorFlowOptions& options);

/// Search for markers and beacons in the images.
struct MarkerSensorOptions {
  int max_markers = 4;  ///< maximum number searched for; the largest are preferred
  /// Number of consecutive images whose markers contradict the expected state.
  int restart_after = 20;
  int search_interval = 20;  ///< images without an accepted marker before a whole image is searched
  MarkerDetectorOptions detector = {};
  BeaconDetectorOptions beacons = {};
  MarkerFilterOptions markers = {};
};
void visit(OptionVisitor& field, MarkerSensorOptions& options);

/// Uncertainty of the initial state.
struct FlightInitializationOptions {
  double velocity_sigma_mps = 1;
  double gyro_bias_sigma = 0.02;  ///< [rad/s]
  double accel_bias_sigma = 0.2;  ///< [m/s^2]
};
void visit(OptionVisitor& field, FlightInitializationOptions& options);

/// Map of the markers after a flight.
struct MarkerMapOptions {
  /// Probability of the gate for an observation against the others of its marker.
  double gate = 0.9999;
  double extra_sigma_px = 0.05;  ///< standard deviation added to that of a corner
  int min_views = 2;             ///< minimum number of views of a mapped marker
  void check() const;
};
void visit(OptionVisitor& field, MarkerMapOptions& options);

/// Options of `placegraph flight run`: of FlightEstimator and of `map_flight_markers`.
///
/// The keys of `flow` and `marker_sensor` are not in groups of their own.
struct FlightOptions {
  double floor_z_m = 0;  ///< height of the level floor in the world
  FloorFlowOptions flow;
  /// Delay of a marker pose after its image, if it is computed on another computer [s].
  double marker_delay_s = 0;
  MarkerSensorOptions marker_sensor;
  FlightInitializationOptions initialization;
  ErrorStateFilterOptions filter;
  /// Time between images that `map_flight_markers` searches completely.
  double map_interval_s = 0.2;
  MarkerMapOptions map;  ///< options of `map_flight_markers`
  void check() const;
};
void visit(OptionVisitor& field, FlightOptions& options);

}  // namespace placegraph
