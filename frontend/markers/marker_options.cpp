#include <placegraph/frontend/markers/marker_options.h>

namespace placegraph {

void visit(OptionVisitor& field, SquareFitOptions& o) {
  field("reach_px", o.reach_px, "maximum distance from a side of the pixels used in its fit [px]",
        {1.5, 20});
  field("min_contrast", o.min_contrast,
        "minimum contrast of a square to its surroundings [grey levels]", {1, 255});
  field("max_sigma_px", o.max_sigma_px, "maximum standard deviation of an accepted corner [px]",
        {0.01, 100});
  field("min_sigma_px", o.min_sigma_px, "minimum standard deviation of a corner [px]", {1e-4, 5});
}

void MarkerDetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerDetectorOptions& o) {
  field("min_side_px", o.min_side_px, "minimum side of a marker [px]", {8, 1000});
  field("correction", o.correction, "share of a dictionary's correctable bits that are corrected",
        {0, 1});
  field("search_margin", o.search_margin, "search margin around an expected marker [marker widths]",
        {0.1, 10});
  field.group("square", o.square, "sub-pixel fit of the sides");
}

void visit(OptionVisitor& field, BeaconDetectorOptions& o) {
  field("min_grey", o.min_grey, "minimum grey value of a spot's brightest pixel [grey levels]",
        {1, 255});
  field("min_contrast", o.min_contrast,
        "minimum contrast of that pixel to the spot's surroundings [grey levels]", {1, 255});
  field("min_area_px", o.min_area_px, "minimum area above half of the contrast [px^2]", {1, 1e5});
  field("max_area_px", o.max_area_px, "maximum area above half of the contrast [px^2]", {1, 1e6});
  field("min_roundness", o.min_roundness, "minimum ratio of the spot's shorter axis to its longer",
        {0, 1});
  field("min_sigma_px", o.min_sigma_px, "minimum standard deviation of a spot [px]", {1e-4, 5});
}

void visit(OptionVisitor& field, BeaconPoseOptions& o) {
  field("gate", o.gate, "probability of the gate between a spot and a projected beacon",
        {0.5, 0.999999});
  field("min_spots", o.min_spots, "minimum number of spots of a pose without a prediction",
        {4, 100});
  field("max_missed", o.max_missed, "maximum share of the beacons in view without a spot", {0, 1});
  field("min_margin", o.min_margin,
        "minimum margin of the second best pose's squared error over the best", {0, 1e6});
  field("max_trials", o.max_trials, "maximum number of assignments of three spots to three beacons",
        {1, 1e8});
}

void MarkerFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerFilterOptions& o) {
  field.formerly("decided_nats")(
      "decided_log_ratio", o.decided_log_ratio,
      "log-likelihood ratio to the best pose at which a pose is rejected", {1, 1000});
  field("extra_sigma_px", o.extra_sigma_px,
        "additional standard deviation of a corner: print, lens, layout [px]", {0, 10});
  field("gate", o.gate, "probability of the gate on a marker's corners, given the camera pose",
        {0.5, 0.999999});
  field("gravity_sigma_deg", o.gravity_sigma_deg,
        "standard deviation of the accelerometer's direction in flight [deg]", {0.1, 90});
  field.formerly("turn_sigma_deg")(
      "rotation_sigma_deg", o.rotation_sigma_deg,
      "standard deviation of the gyro's rotation from view to view [deg]", {1e-3, 90});
  field.formerly("max_turn_rad_s")("max_rotation_rad_s", o.max_rotation_rad_s,
                                   "maximum rotation rate of the body without a gyro [rad/s]",
                                   {0.01, 100});
  field("max_speed_m_s", o.max_speed_m_s, "maximum speed of the body [m/s]", {0.01, 100});
  field("memory_s", o.memory_s, "age after which hypotheses without an observation are removed [s]",
        {0, 60});
  field.group("beacons", o.beacons, "pose from bright spots at known positions");
}

}  // namespace placegraph
