#pragma once
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct SquareFitOptions {
  double reach_px = 4;      ///< pixels so far from a side shape it, at most
  double min_contrast = 8;  ///< grey levels between the square and what is around it
  double max_sigma_px = 1;  ///< a corner known worse than that is none
  double min_sigma_px =
      0.02;  ///< of a corner: no lens and no print is better, whatever the fit says
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SquareFitOptions& options);

struct MarkerDetectorOptions {
  double min_side_px = 12;     ///< smaller markers are not looked for
  double correction = 0.5;     ///< share of a dictionary's correctable bits that are corrected
  double search_margin = 0.6;  ///< around an expected marker, in its widths, where it is looked for
  SquareFitOptions square;
  void check() const;
};
void visit(OptionVisitor& field, MarkerDetectorOptions& options);

struct BeaconDetectorOptions {
  double min_grey = 200;     ///< of a spot's brightest pixel
  double min_contrast = 80;  ///< of that over what surrounds the spot, grey levels
  double min_area_px = 2;    ///< above half of that contrast
  double max_area_px = 900;
  double min_roundness = 0.6;  ///< the spot's shorter axis over its longer
  double min_sigma_px = 0.05;  ///< of a spot: no better, whatever the grey values say
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, BeaconDetectorOptions& options);

struct BeaconPoseOptions {
  double gate = 0.999;  ///< a spot is a beacon's where its distance is likelier than one minus this
  int min_spots = 4;    ///< of one pose from nothing
  double max_missed = 0.34;  ///< share of the beacons in view that no spot belongs to
  double min_margin = 12;    ///< of the next pose's squared error over the best one's
  int max_trials = 200000;   ///< assignments of three spots to three beacons
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, BeaconPoseOptions& options);

struct MarkerFilterOptions {
  double decided_log_ratio = 14;    ///< a pose so much less likely than the best one is refuted
  double extra_sigma_px = 0.05;     ///< of a corner beside its own: print, lens, layout
  double gate = 0.9999;             ///< of a marker's corners under a pose of the camera
  double gravity_sigma_deg = 10;    ///< of the accelerometer's direction in flight
  double rotation_sigma_deg = 0.3;  ///< of the gyro's turn from view to view
  double max_rotation_rad_s = 2;    ///< without a gyro
  double max_speed_m_s = 3;
  double memory_s = 1;  ///< what was not seen for so long is forgotten
  BeaconPoseOptions beacons;
  void check() const;
};
void visit(OptionVisitor& field, MarkerFilterOptions& options);

}  // namespace placegraph
