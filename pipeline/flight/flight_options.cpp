#include <placegraph/pipeline/flight/flight_options.h>

namespace placegraph {

void visit(OptionVisitor& field, FlightOptions& o) {
  field.basic()("floor_z_m", o.floor_z_m, "height of the floor in the world frame [m]",
                {-1e6, 1e6});
  visit(field, o.flow);
  field.basic()("marker_delay_s", o.marker_delay_s, "delay of marker poses after their image [s]",
                {0, 60});
  visit(field, o.marker_sensor);
  field.group("tracker", o.flow.tracker, "tracking of corners on the floor");
  field.formerly("start").group("initialization", o.initialization,
                                "uncertainty of the initial state");
  field.basic().group("filter", o.filter, "sensor noise and gates of the position filter");
  field.basic()("map_interval_s", o.map_interval_s,
                "time between images that are searched completely for markers to map [s]", {0, 60});
  field.group("map", o.map, "mapping of markers with unknown poses");
}

void FlightOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloorFlowOptions& o) {
  field("flow_noise_px", o.noise_px,
        "standard deviation of a tracked point, beyond image noise [px]", {0, 10});
  field("flow_common_px", o.common_px, "error common to all points of an image pair [px]", {0, 10});
  field("min_flow_points", o.min_points, "minimum number of inliers for a flow measurement",
        {6, 10000});
  field.basic()("use_flow", o.enabled, "use flow over the floor");
}

void visit(OptionVisitor& field, MarkerSensorOptions& o) {
  field.basic()("max_markers", o.max_markers,
                "maximum number of markers searched for; the largest are preferred", {1, 1000});
  field("restart_after", o.restart_after,
        "consecutive images with contradicting markers before the filter restarts", {1, 100000});
  field("search_interval", o.search_interval,
        "images without an accepted marker before a whole image is searched", {1, 1000});
  field.group("detector", o.detector, "detection of markers");
  field.group("beacons", o.beacons, "detection of beacons");
  field.group("markers", o.markers, "poses from markers and beacons");
}

void visit(OptionVisitor& field, FlightInitializationOptions& o) {
  field("velocity_sigma_mps", o.velocity_sigma_mps,
        "initial standard deviation of the velocity per axis [m/s]", {1e-3, 100});
  field("gyro_bias_sigma", o.gyro_bias_sigma, "initial standard deviation of the gyro bias [rad/s]",
        {1e-6, 1});
  field("accel_bias_sigma", o.accel_bias_sigma,
        "initial standard deviation of the accelerometer bias [m/s^2]", {1e-6, 10});
}

void MarkerMapOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerMapOptions& o) {
  field("gate", o.gate,
        "probability of the gate for an observation against the others of its marker",
        {0.5, 0.999999});
  field("extra_sigma_px", o.extra_sigma_px, "standard deviation added to that of a corner [px]",
        {0, 10});
  field("min_views", o.min_views, "minimum number of views of a mapped marker", {1, 1e6});
}

}  // namespace placegraph
