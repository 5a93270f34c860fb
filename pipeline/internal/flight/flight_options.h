#pragma once
#include <placegraph/backend/internal/inertial/inertial_options.h>
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/internal/markers/marker_options.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct FloorFlowOptions {
  double noise_px = 0.05;  ///< of a tracked point, beside what the noise of the image makes
  /// Error common to all flow vectors of an image pair [px]. Chosen so that the drift over seconds
  /// above rendered floors is covered; the scatter of the vectors would tell a fraction of it.
  double common_px = 0.025;
  int min_points = 12;  ///< with fewer inliers there is no measurement
  bool enabled = true;  ///< whether a measurement is made of the flow
  /// Weak corners are tracked too, as their covariance weighs them; steps are not compared with the
  /// first patch of a track. In `FlightOptions` a group of its own, which `PointTracker` checks.
  PointTrackerOptions tracker{.max_tracks = 120,
                              .window_px = 15,
                              .pyramid_levels = 4,
                              .min_eigenvalue = 1e-4,
                              .max_anchor_shift_px = 0};
};

struct MarkerSensorOptions {
  int max_markers = 4;       ///< searched for where more are expected: the largest
  int restart_after = 20;    ///< images in a row whose markers contradict the expected state
  int search_interval = 20;  ///< images without an accepted marker until one is searched whole
  MarkerDetectorOptions detector = {};
  BeaconDetectorOptions beacons = {};
  MarkerFilterOptions markers = {};
};
void visit(OptionVisitor& field, MarkerSensorOptions& options);

/// What is not known of a body at the start.
struct FlightInitializationOptions {
  double velocity_sigma_mps = 1;
  double gyro_bias_sigma = 0.02;  ///< [rad/s]
  double accel_bias_sigma = 0.2;  ///< [m/s^2]
};
void visit(OptionVisitor& field, FlightInitializationOptions& options);

struct MarkerMapOptions {
  double gate = 0.9999;          ///< of a sighting against what the others say of its marker
  double extra_sigma_px = 0.05;  ///< of a corner, beside its own
  int min_views = 2;             ///< of a marker that is mapped
  void check() const;
};
void visit(OptionVisitor& field, MarkerMapOptions& options);

/// Options of `placegraph hover`: of FlightEstimator and of `map_flight_markers`. The keys of
/// `flow` and `marker_sensor` are not in groups of their own.
struct FlightOptions {
  double floor_z_m = 0;  ///< height of the level floor in the world
  FloorFlowOptions flow;
  /// A pose by markers comes so much later than its image, as where another computer finds it.
  double marker_delay_s = 0;
  MarkerSensorOptions marker_sensor;
  FlightInitializationOptions start;
  PositionFilterOptions filter;
  double map_interval_s = 0.2;  ///< of `map_flight_markers`, between images that are searched whole
  MarkerMapOptions map;         ///< of the same
  void check() const;
};
void visit(OptionVisitor& field, FlightOptions& options);

}  // namespace placegraph
