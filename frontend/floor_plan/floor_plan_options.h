#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Surface points with normals from a depth image.
struct SurfacePointOptions {
  int step_px = 8;          ///< distance of neighbouring points in the image
  int radius_px = 8;        ///< half the side of the patch that determines the normal
  double max_range_m = 15;  ///< farther points are not used
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SurfacePointOptions& options);

/// Dense depth of a rectified stereo pair by semi-global matching.
struct DenseStereoOptions {
  int disparities = 96;  ///< number of disparities searched, from 0 px on; a multiple of 16
  int window_px = 9;     ///< side of the matched blocks
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DenseStereoOptions& options);

/// Costs of depth differences between neighbouring pixels (Hirschmueller 2008), 0 to 4000.
struct PathCosts {
  int step = 8;   ///< cost of a difference by one level of depth
  int jump = 32;  ///< cost of a larger difference
};

/// Depth of an image from other images of known poses by plane sweep (Collins 1996).
struct PlaneSweepOptions {
  double min_depth_m = 0.7, max_depth_m = 15;  ///< range of depths searched
  int max_width_px = 400;                      ///< wider images are halved until they are not
  /// Maximum cost of a depth over its pixel's mean cost for a depth that is distinct without its
  /// neighbours.
  double distinct = 0.6;
  void check() const;
};
void visit(OptionVisitor& field, PlaneSweepOptions& options);

/// Surface points from a single image of a camera of known height with the floor in view.
struct SkirtingLineOptions {
  double max_range_m = 6;  ///< farther surfaces are not used
  /// Maximum height of skirting boards: a wall's foot is its lowest edge within this height, since
  /// the upper edge of a skirting board is mostly the clearer one. 0: the foot is the end of the
  /// floor's label.
  double skirting_m = 0.15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SkirtingLineOptions& options);

/// Walls from surface points: upright planes along two orthogonal axes of the building.
struct WallFinderOptions {
  double band_m = 0.05;  ///< half the thickness of a set of points that counts as one plane
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, WallFinderOptions& options);

/// Doors in walls: openings and closed leaves.
struct DoorFinderOptions {
  double min_width_m = 0.6, max_width_m = 2.2;  ///< width of a door
  double min_head_m = 1.8, max_head_m = 2.5;    ///< height of an opening's head above the floor
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DoorFinderOptions& options);

/// Partition of the free space into rooms.
struct RoomPartitionOptions {
  double min_area_m2 = 2;  ///< minimum area of a room
  double neck_m = 0.7;     ///< free space narrower than this separates rooms
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RoomPartitionOptions& options);

}  // namespace placegraph
