#include <placegraph/pipeline/internal/flight/flight_options.h>

namespace placegraph {

void visit(OptionVisitor& field, FlightOptions& o) {
  field("floor_z_m", o.floor_z_m, "height of the floor in the world", {-1e6, 1e6});
  visit(field, o.flow);
  field("marker_delay_s", o.marker_delay_s, "poses by markers come so much after their image",
        {0, 60});
  visit(field, o.marker_sensor);
  field.group("tracker", o.flow.tracker, "corners of the floor that are followed");
  field.group("start", o.start, "what a body that begins does not know");
  field.group("filter", o.filter, "how the sensors err, and what is believed");
  field("map_interval_s", o.map_interval_s,
        "between images that are searched whole for markers to be mapped", {0, 60});
  field.group("map", o.map, "markers whose place is not known");
}

void FlightOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloorFlowOptions& o) {
  field("flow_noise_px", o.noise_px, "of a followed point, beside what the image's noise makes",
        {0, 10});
  field("flow_common_px", o.common_px, "what all points of an image pair err alike", {0, 10});
  field("min_flow_points", o.min_points, "with fewer, flow says nothing", {6, 10000});
  field("use_flow", o.enabled, "whether flow over the floor is heeded");
}

void visit(OptionVisitor& field, MarkerSensorOptions& o) {
  field("max_markers", o.max_markers, "looked for where more are expected: the largest", {1, 1000});
  field("restart_after", o.restart_after,
        "images in a row whose markers contradict the filter, until it begins anew", {1, 100000});
  field("search_interval", o.search_interval,
        "images without a believed marker, until one is searched whole", {1, 1000});
  field.group("detector", o.detector, "how markers are found");
  field.group("beacons", o.beacons, "how beacons are found");
  field.group("markers", o.markers, "how markers and beacons become poses");
}

void visit(OptionVisitor& field, FlightInitializationOptions& o) {
  field("velocity_sigma_mps", o.velocity_sigma_mps, "of a body that begins, each axis",
        {1e-3, 100});
  field("gyro_bias_sigma", o.gyro_bias_sigma, "rad/s, before anything is known of it", {1e-6, 1});
  field("accel_bias_sigma", o.accel_bias_sigma, "m/s^2, likewise", {1e-6, 10});
}

void MarkerMapOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerMapOptions& o) {
  field("gate", o.gate, "of a sighting against what the others say of its marker", {0.5, 0.999999});
  field("extra_sigma_px", o.extra_sigma_px, "of a corner, beside its own", {0, 10});
  field("min_views", o.min_views, "of a marker that is mapped", {1, 1e6});
}

}  // namespace placegraph
