#pragma once
#include <placegraph/frontend/lines/line_initializer.h>
#include <placegraph/frontend/lines/line_stereo.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/frontend/lines/pose_from_lines.h>
#include <placegraph/pipeline/scale/floor_line_scale_options.h>

namespace placegraph {

struct LineCueOptions {
  LineTrackerOptions tracker;
  LineStereoOptions stereo;
  LineTriangulationOptions triangulation;
  PoseFromLinesOptions pose;
  LineInitializerOptions start;
  FloorScaleOptions floor;
  double sigma_floor_px = 0.15;  ///< no line is placed better across: lens, rolling shutter, blur
  /// What one look at an edge errs by stays while it is followed: so many sightings in the window
  /// are worth one independent one.
  double alike_sightings = 16;
  /// In place of triangulation.min_turn_deg where directions show the rotation, and turns of planes
  /// are those of the way alone: with what is not known of its place, a line is of use much sooner.
  double min_turn_steered_deg = 0.4;
  int stay_frames = 10;   ///< an edge that the motion takes out of the image before is begun last
  double outlier_px = 4;  ///< a line of the window that is missed by more is dropped
  void check() const;
};
void visit(OptionVisitor& field, LineCueOptions& options);

}  // namespace placegraph
