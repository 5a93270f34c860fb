#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Surface points with normals from a depth image.
struct SurfacePointOptions {
  int step_px = 8;    ///< distance of neighbouring points in the image
  int radius_px = 8;  ///< half the side of the patch that determines the normal
  /// Maximum relative rms distance of a patch's inverse depths from its plane, beyond their noise;
  /// a point with a larger one has no normal.
  double max_residual = 0.01;
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
  double step_px = 1;    ///< displacement between two planes in the image that moves most
  int max_planes = 192;  ///< maximum number of planes; their spacing grows if more would be needed
  int window_px = 9;     ///< window over which brightness and contrast are normalized
  /// Weakest contrast that is normalized to full strength, in standard deviations of the image
  /// noise, but at least one grey level.
  double noise_share = 2.7;
  int block_px = 5;          ///< window over which costs are averaged
  PathCosts paths;           ///< smoothness over neighbouring pixels
  double uniqueness = 0.05;  ///< relative lead that a depth must have over any other
  /// Maximum cost of a depth over its pixel's mean cost for a depth that is distinct without its
  /// neighbours.
  double distinct = 0.6;
  double sigma_px = 0.3;  ///< standard deviation of the position of a surface in another image
  void check() const;
};
void visit(OptionVisitor& field, PlaneSweepOptions& options);

/// Surface points from a single image of a camera of known height with the floor in view.
struct SkirtingLineOptions {
  double max_range_m = 6;          ///< farther surfaces are not used
  int step_px = 8;                 ///< distance of neighbouring points in the image
  double sigma_boundary_px = 1.5;  ///< standard deviation of the row where floor and wall meet
  /// Maximum height of skirting boards: a wall's foot is its lowest edge within this height, since
  /// the upper edge of a skirting board is mostly the clearer one. 0: the foot is the end of the
  /// floor's label.
  double skirting_m = 0.15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SkirtingLineOptions& options);

/// Walls from surface points: upright planes along two orthogonal axes of the building.
struct WallFinderOptions {
  double max_sigma_m = 0.12;     ///< maximum standard deviation of a point that is used
  double max_rotation_deg = 15;  ///< maximum angle between the normals of a point and its wall
  double band_m = 0.05;          ///< half the thickness of a set of points that counts as one plane
  double min_height_m = 0.8;     ///< minimum observed height of a wall, in all its parts together
  double min_share = 0.6;  ///< minimum share of wall in the height that is observed or seen through
  double max_gap_m = 0.3;  ///< longest gap within a wall
  double min_length_m = 0.4;  ///< minimum length of a wall
  /// Maximum offset between pieces of one wall, caused by drift of the poses.
  double max_step_m = 0.07;
  /// Minimum height of the upper end of short pieces: door leaves and furniture end below it.
  double min_top_m = 2.3;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, WallFinderOptions& options);

/// Doors in walls: openings and closed leaves.
struct DoorFinderOptions {
  double min_width_m = 0.6, max_width_m = 2.2;  ///< width of a door
  double min_head_m = 1.8, max_head_m = 2.5;    ///< height of an opening's head above the floor
  double min_recess_m = 0.025, max_recess_m = 0.16;  ///< depth of a leaf behind the wall's surface
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DoorFinderOptions& options);

/// Partition of the free space into rooms.
struct RoomPartitionOptions {
  double min_area_m2 = 2;  ///< minimum area of a room
  double neck_m = 0.7;     ///< free space narrower than this separates rooms
  /// Maximum distance from free cells at which unseen cells count as free.
  double closing_m = 0.15;
  /// Share of a box between walls above which the whole box is added to the room.
  double completed_share = 0.5;
  /// Maximum share of walls in the border of an unseen part that is filled into a room.
  double walled_share = 0.2;
  double outline_m = 0.08;  ///< maximum error of the polygon that outlines a room
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RoomPartitionOptions& options);

}  // namespace placegraph
