#include <placegraph/frontend/internal/markers/marker_options.h>

namespace placegraph {

void visit(OptionVisitor& field, SquareFitOptions& o) {
  field("reach_px", o.reach_px, "pixels so far from a side shape it, at most", {1.5, 20});
  field("min_contrast", o.min_contrast, "grey levels between a square and its surroundings",
        {1, 255});
  field("max_sigma_px", o.max_sigma_px, "a corner known worse than that is none", {0.01, 100});
  field("min_sigma_px", o.min_sigma_px, "of a corner, whatever the fit says", {1e-4, 5});
}

void MarkerDetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerDetectorOptions& o) {
  field("min_side_px", o.min_side_px, "smaller markers are not looked for", {8, 1000});
  field("correction", o.correction, "share of the correctable bits that are corrected", {0, 1});
  field("search_margin", o.search_margin,
        "around an expected marker, in its widths, where it is looked for", {0.1, 10});
  field.group("square", o.square, "sub-pixel fit of the sides");
}

void visit(OptionVisitor& field, BeaconDetectorOptions& o) {
  field("min_grey", o.min_grey, "of a spot's brightest pixel", {1, 255});
  field("min_contrast", o.min_contrast, "over what surrounds a spot, grey levels", {1, 255});
  field("min_area_px", o.min_area_px, "above half of the contrast", {1, 1e5});
  field("max_area_px", o.max_area_px, "larger ones are no beacons", {1, 1e6});
  field("min_roundness", o.min_roundness, "shorter axis over longer", {0, 1});
  field("min_sigma_px", o.min_sigma_px, "of a spot, whatever the grey values say", {1e-4, 5});
}

void visit(OptionVisitor& field, BeaconPoseOptions& o) {
  field("gate", o.gate, "a spot is a beacon's where it is likelier than one minus this",
        {0.5, 0.999999});
  field("min_spots", o.min_spots, "of a pose from nothing", {4, 100});
  field("max_missed", o.max_missed, "share of the beacons in view without a spot", {0, 1});
  field("min_margin", o.min_margin, "of the next pose's squared error over the best", {0, 1e6});
  field("max_trials", o.max_trials, "assignments of three spots to three beacons", {1, 1e8});
}

void MarkerFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerFilterOptions& o) {
  field("decided_log_ratio", o.decided_log_ratio,
        "a pose so much less likely than the best one is refuted", {1, 1000});
  field("extra_sigma_px", o.extra_sigma_px, "of a corner beside its own: print, lens, layout",
        {0, 10});
  field("gate", o.gate, "of a marker's corners under a pose of the camera", {0.5, 0.999999});
  field("gravity_sigma_deg", o.gravity_sigma_deg, "of the accelerometer's direction in flight",
        {0.1, 90});
  field("rotation_sigma_deg", o.rotation_sigma_deg, "of the gyro's turn from view to view",
        {1e-3, 90});
  field("max_rotation_rad_s", o.max_rotation_rad_s, "of the body, where there is no gyro",
        {0.01, 100});
  field("max_speed_m_s", o.max_speed_m_s, "of the body", {0.01, 100});
  field("memory_s", o.memory_s, "what was not seen for so long is forgotten", {0, 60});
  field.group("beacons", o.beacons, "bright spots of known places");
}

}  // namespace placegraph
