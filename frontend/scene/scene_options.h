#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Orientations of surfaces in a single image by line sweeping (Lee, Hebert & Kanade 2009).
struct OrientationMapOptions {
  double cell_px = 3;     ///< side of the cells of the raster that lines are swept over
  double min_margin = 2;  ///< minimum ratio of the support of the best to the second orientation
  double min_confidence = 0.1;  ///< pixels of less confidence (0 to 1) get no orientation
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, OrientationMapOptions& options);

/// Masks from surface labels for tracking, place cues and the ground plane.
///
/// A label counts if its probability reaches the least one; all other pixels are used.
struct SceneMaskOptions {
  bool sky = true;          ///< mask the sky
  bool moving = true;       ///< mask objects that may move: cars, people, bicycles
  bool ground = true;       ///< align the ground plane only on ground pixels
  double min_sky = 0.9;     ///< minimum probability of sky; overexposed walls are below it
  double min_moving = 0.6;  ///< minimum probability of an object that may move
  double min_ground = 0.5;  ///< minimum probability of ground
  int margin_px = 4;        ///< margin around objects that may move, as their contours move too
  /// Minimum share of the image that a mask leaves; otherwise it is not used.
  double min_share = 0.25;
  void check() const;
};
void visit(OptionVisitor& field, SceneMaskOptions& options);

/// Filter of the kind of environment over consecutive keyframes (hidden Markov model).
struct EnvironmentFilterOptions {
  double enter = 0.8;  ///< probability from which a kind is accepted
  double leave = 0.4;  ///< probability below which the accepted kind is dropped
  void check() const;
};
void visit(OptionVisitor& field, EnvironmentFilterOptions& options);

}  // namespace placegraph
