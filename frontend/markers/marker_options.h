#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Sub-pixel fit of a square marker's sides.
struct SquareFitOptions {
  double reach_px = 4;         ///< maximum distance from a side of the pixels used in its fit
  double min_contrast = 8;     ///< between the square and its surroundings [grey levels]
  double max_sigma_px = 1;     ///< maximum standard deviation of an accepted corner
  double min_sigma_px = 0.02;  ///< minimum standard deviation of a corner: limit of lens and print
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SquareFitOptions& options);

/// Detection of fiducial markers.
struct MarkerDetectorOptions {
  double min_side_px = 12;     ///< smaller markers are not searched
  double correction = 0.5;     ///< share of a dictionary's correctable bits that are corrected
  double search_margin = 0.6;  ///< search margin around an expected marker [marker widths]
  SquareFitOptions square;
  void check() const;
};
void visit(OptionVisitor& field, MarkerDetectorOptions& options);

/// Detection of beacons: bright spots.
struct BeaconDetectorOptions {
  double min_grey = 200;     ///< minimum grey value of a spot's brightest pixel
  double min_contrast = 80;  ///< contrast of that pixel to the surroundings [grey levels]
  double min_area_px = 2;    ///< area of the pixels above half of that contrast
  double max_area_px = 900;
  double min_roundness = 0.6;  ///< the spot's shorter axis over its longer
  double min_sigma_px = 0.05;  ///< minimum standard deviation of a spot
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, BeaconDetectorOptions& options);

/// Camera pose from beacons at known positions.
struct BeaconPoseOptions {
  double gate = 0.999;       ///< probability of the gate between a spot and a projected beacon
  int min_spots = 4;         ///< minimum number of spots of a pose without a prediction
  double max_missed = 0.34;  ///< maximum share of the beacons in view without a spot
  double min_margin = 12;  ///< minimum margin of the second best pose's squared error over the best
  int max_trials = 200000;  ///< maximum number of assignments of three spots to three beacons
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, BeaconPoseOptions& options);

/// Filter over the poses that the markers and beacons of several frames allow.
struct MarkerFilterOptions {
  double decided_log_ratio =
      14;  ///< log-likelihood ratio to the best pose at which a pose is rejected
  double extra_sigma_px = 0.05;  ///< additional standard deviation of a corner: print, lens, layout
  double gate = 0.9999;  ///< probability of the gate on a marker's corners, given the camera pose
  double gravity_sigma_deg = 10;  ///< standard deviation of the accelerometer's direction in flight
  double rotation_sigma_deg = 0.3;  ///< standard deviation of the gyro's rotation from view to view
  double max_rotation_rad_s = 2;    ///< maximum rotation rate of the body without a gyro
  double max_speed_m_s = 3;         ///< maximum speed of the body
  double memory_s = 1;              ///< hypotheses without an observation for this long are removed
  BeaconPoseOptions beacons;
  void check() const;
};
void visit(OptionVisitor& field, MarkerFilterOptions& options);

}  // namespace placegraph
