#pragma once
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

struct OrientationMapOptions {
  double cell_px = 3;      ///< of the raster that lines are swept over
  double max_sweep = 0.6;  ///< way from an edge that it still speaks for [image widths]
  double min_margin = 2;   ///< the best orientation against the second, where two are supported
  double min_confidence = 0.1;  ///< pixels below it have no orientation
  int smoothing_cells = 2;      ///< radius of the vote among neighbours; 0: none
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, OrientationMapOptions& options);

struct SeenThroughOptions {
  double min_disparity_px = 2;  ///< by which what stands behind must be farther
  int radius_px = 2;            ///< all around must be so
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SeenThroughOptions& options);

struct UrbanGeometryOptions {
  double disparity_sigma_px = 0.25;  ///< of one pixel
  double ground_sigma_m = 0.03;      ///< how even the ground is, near by, and ...
  double ground_sigma_rate = 0.004;  ///< ... more of it by the metre of distance
  double outliers = 0.05;            ///< share of superpixels whose place says nothing
  double weight = 1;                 ///< of the terms in the random field; 0: none
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, UrbanGeometryOptions& options);

/// How much of a model is used: for measuring what each part brings.
struct LabellerOptions {
  bool context = true;  ///< the second forest
  bool field = true;    ///< the random field
  /// Its table of relations: off, for the second forest sees who lies where already, and on a day
  /// that was not learned from the table counts the same evidence twice.
  bool relations = false;
  int rounds = 2;  ///< of the second forest
  void check() const;
};
void visit(OptionVisitor& field, LabellerOptions& options);

struct UrbanSightOptions {
  int step_px = 6;          ///< between points
  double max_range_m = 40;  ///< farther points are not used
  double max_residual = 3;  ///< standard deviations of a disparity from its superpixel's plane
  /// Classes that move, joined by commas: what is one of them is no part of the map.
  std::string moving = "Car,Pedestrian,Bicyclist";
  UrbanGeometryOptions geometry;
  LabellerOptions labeller;
  void check() const;
};
void visit(OptionVisitor& field, UrbanSightOptions& options);

/// What labels of surfaces keep out of tracking and of place cues, and where they let the ground be
/// looked at. A label counts where it is this probable; elsewhere the picture is used as it is.
struct SceneMaskOptions {
  bool sky = true;       ///< nothing is looked for in the sky
  bool moving = true;    ///< nor on what may move: cars, people, bicycles
  bool ground = true;    ///< the road is measured only where it is ground
  double min_sky = 0.9;  ///< overexposed walls pass for sky below that
  double min_moving = 0.6;
  double min_ground = 0.5;
  int margin_px = 4;        ///< about what may move: its contour moves too
  double min_share = 0.25;  ///< of the picture that must be left, otherwise no mask is used
  void check() const;
};
void visit(OptionVisitor& field, SceneMaskOptions& options);

struct EnvironmentFilterOptions {
  double stay = 0.97;     ///< probability that the next view is of the same kind
  double evidence = 0.5;  ///< power of a view's probabilities: neighbours err alike
  double enter = 0.8;     ///< probability from which a kind is taken
  double leave = 0.4;     ///< and below which it is given up
  int min_views = 3;      ///< before anything is said
  void check() const;
};
void visit(OptionVisitor& field, EnvironmentFilterOptions& options);

}  // namespace placegraph
