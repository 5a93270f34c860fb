#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct SurfacePointOptions {
  int step_px = 8;             ///< between points
  int radius_px = 8;           ///< of the patch whose plane gives the normal
  double max_residual = 0.01;  ///< of inverse depths from it, relative, rms, beside noise
  double max_range_m = 15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SurfacePointOptions& options);

struct DenseStereoOptions {
  int disparities = 96;  ///< searched from 0 on [px], a multiple of 16
  int window_px = 9;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DenseStereoOptions& options);

struct PathCosts {
  int step = 8;   ///< of neighbours that differ by one level
  int jump = 32;  ///< by more
};

struct PlaneSweepOptions {
  double min_depth_m = 0.7, max_depth_m = 15;
  int max_width_px = 400;    ///< wider images are halved
  double step_px = 1;        ///< between two planes, where a view moves most
  int max_planes = 192;      ///< farther apart where more would be needed
  int window_px = 9;         ///< over which brightness and contrast are made alike
  double noise_share = 2.7;  ///< contrast below so many deviations of noise (and 1) counts little
  int block_px = 5;          ///< over which costs are averaged
  PathCosts paths;
  double uniqueness = 0.05;  ///< by which a depth must be better than any other
  double distinct = 0.6;     ///< cost of a depth that the pixel tells by itself, of its mean cost
  double sigma_px = 0.3;     ///< of where a surface is seen in another view
  void check() const;
};
void visit(OptionVisitor& field, PlaneSweepOptions& options);

struct FloorSightOptions {
  double max_range_m = 6;
  int step_px = 8;
  double sigma_boundary_px = 1.5;  ///< of the row where floor and wall meet
  /// A wall's lowest edge, up to so far below where the map's floor ends, is its foot: the upper
  /// edge of a skirting board is mostly the clearer one. 0: the map alone.
  double skirting_m = 0.15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, FloorSightOptions& options);

struct WallFinderOptions {
  double max_sigma_m = 0.12;  ///< of points that walls are found from
  double max_turn_deg = 15;   ///< of a point's normal from the wall's
  double band_m = 0.05;       ///< half width of what counts as one plane
  double min_height_m = 0.8;  ///< that must be seen of a wall, one part above the other
  double min_share = 0.6;     ///< of the looked at height that must be wall
  double max_gap_m = 0.3;     ///< within a wall
  double min_length_m = 0.4;
  double max_step_m = 0.07;  ///< between pieces of one wall: what drift of the poses makes of it
  double min_top_m =
      2.3;  ///< of what is shorter than a door is high: leaves and furniture end below
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, WallFinderOptions& options);

struct DoorFinderOptions {
  double min_width_m = 0.6, max_width_m = 2.2;
  double min_head_m = 1.8, max_head_m = 2.5;         ///< of an opening's head above the floor
  double min_recess_m = 0.025, max_recess_m = 0.16;  ///< of a leaf behind its wall's surface
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DoorFinderOptions& options);

struct RoomPartitionOptions {
  double min_area_m2 = 2;
  double neck_m = 0.7;           ///< free space narrower than this parts rooms
  double closing_m = 0.15;       ///< unseen cells so near to free ones are free
  double completed_share = 0.5;  ///< of a box between walls that is seen free: all of it is
  double walled_share = 0.2;  ///< of an unseen part's border: with more, it is no part of the room
  double outline_m = 0.08;    ///< tolerance of a room's outline
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RoomPartitionOptions& options);

}  // namespace placegraph
