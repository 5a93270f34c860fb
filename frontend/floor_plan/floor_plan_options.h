#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Surface points with normals from a depth image.
struct SurfacePointOptions {
  int step_px = 8;    ///< distance of neighbouring points in the image
  int radius_px = 8;  ///< half the side of the patch whose plane gives the normal
  /// Largest relative rms distance of a patch's inverse depths from its plane, beside their noise;
  /// beyond, the point has no normal.
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
  int step = 8;   ///< for a difference by one level of depth
  int jump = 32;  ///< for a larger difference
};

/// Depth of an image from other images of known poses by plane sweep (Collins 1996).
struct PlaneSweepOptions {
  double min_depth_m = 0.7, max_depth_m = 15;  ///< range of depths searched
  int max_width_px = 400;                      ///< wider images are halved until they are not
  double step_px = 1;    ///< displacement between two planes in the image that moves most
  int max_planes = 192;  ///< most planes; their distance grows where more would be needed
  int window_px = 9;     ///< window over which brightness and contrast are normalized
  /// Weakest contrast that is normalized to full strength, in standard deviations of the image
  /// noise, but at least one grey level.
  double noise_share = 2.7;
  int block_px = 5;          ///< window over which costs are averaged
  PathCosts paths;           ///< smoothness over neighbouring pixels
  double uniqueness = 0.05;  ///< relative lead that a depth must have over any other
  /// Largest cost of a depth over its pixel's mean cost to call the depth distinct without its
  /// neighbours.
  double distinct = 0.6;
  double sigma_px = 0.3;  ///< standard deviation of where a surface is seen in another image
  void check() const;
};
void visit(OptionVisitor& field, PlaneSweepOptions& options);

/// Surface points from a single image of a camera of known height that sees the floor.
struct SkirtingLineOptions {
  double max_range_m = 6;          ///< farther surfaces are not used
  int step_px = 8;                 ///< distance of neighbouring points in the image
  double sigma_boundary_px = 1.5;  ///< standard deviation of the row where floor and wall meet
  /// Largest height of skirting boards: a wall's foot is its lowest edge within this height, since
  /// the upper edge of a skirting board is mostly the clearer one. 0: where the floor's label ends.
  double skirting_m = 0.15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SkirtingLineOptions& options);

/// Walls from surface points: upright planes along two orthogonal axes of the building.
struct WallFinderOptions {
  double max_sigma_m = 0.12;     ///< largest standard deviation of a point that is used
  double max_rotation_deg = 15;  ///< largest angle between the normals of a point and its wall
  double band_m = 0.05;          ///< half the thickness of what counts as one plane
  double min_height_m = 0.8;     ///< least height that is seen of a wall, in all its parts together
  double min_share = 0.6;        ///< least share of wall in the height that is seen or seen through
  double max_gap_m = 0.3;        ///< longest gap within a wall
  double min_length_m = 0.4;     ///< least length of a wall
  double max_step_m = 0.07;  ///< largest offset between pieces of one wall, by drift of the poses
  /// Least height of the upper end of short pieces: door leaves and furniture end below it.
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
  double min_area_m2 = 2;   ///< least area of a room
  double neck_m = 0.7;      ///< free space narrower than this separates rooms
  double closing_m = 0.15;  ///< unseen cells this near to free ones count as free
  /// A box between walls belongs to a room as a whole if more than this share of it does.
  double completed_share = 0.5;
  /// An unseen part is not filled into a room if walls are more than this share of its border.
  double walled_share = 0.2;
  double outline_m = 0.08;  ///< largest error of the polygon that outlines a room
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RoomPartitionOptions& options);

}  // namespace placegraph
