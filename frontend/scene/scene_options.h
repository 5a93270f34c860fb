#pragma once
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Orientations of surfaces in a single image by line sweeping (Lee, Hebert & Kanade 2009).
struct OrientationMapOptions {
  double cell_px = 3;      ///< side of the cells of the raster that lines are swept over
  double max_sweep = 0.6;  ///< longest sweep of an edge [image widths]
  double min_margin = 2;   ///< least ratio of the support of the best to the second orientation
  double min_confidence = 0.1;  ///< pixels of less confidence (0 to 1) get no orientation
  int smoothing_cells = 2;      ///< radius of the vote among neighbouring cells; 0: none
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, OrientationMapOptions& options);

/// When another image sees through a point, so that nothing stood there.
struct SeenThroughOptions {
  double min_disparity_px = 2;  ///< least disparity between the point and what is seen behind it
  int radius_px = 2;            ///< all depths within this distance must be farther
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SeenThroughOptions& options);

/// How height above ground and surface normal vote for the class of a superpixel.
struct UrbanGeometryOptions {
  double disparity_sigma_px = 0.25;  ///< least standard deviation of the disparity of one pixel
  double ground_sigma_m = 0.03;      ///< unevenness of the ground at the camera
  double ground_sigma_rate = 0.004;  ///< increase of it per metre of distance [m/m]
  double outliers = 0.05;            ///< share of superpixels whose geometry says nothing
  double weight = 1;                 ///< of height and normal in the random field; 0: not used
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, UrbanGeometryOptions& options);

/// Which parts of a model label the superpixels of an image.
struct LabellerOptions {
  bool context = true;  ///< a second forest that sees the labels of neighbouring superpixels
  bool field = true;    ///< a random field: neighbours that look alike tend to the same label
  /// The field's table of which classes lie above and beside which. Off, because the second forest
  /// sees that already, and the table counts the same evidence twice.
  bool relations = false;
  int rounds = 2;  ///< applications of the second forest
  void check() const;
};
void visit(OptionVisitor& field, LabellerOptions& options);

/// What a stereo keyframe contributes to the semantic map of a street.
struct StreetLabellingOptions {
  int step_px = 6;          ///< distance of neighbouring points in the image
  double max_range_m = 40;  ///< farther points are not used
  /// Largest distance of a disparity from its superpixel's plane, in standard deviations.
  double max_residual = 3;
  /// Classes that move, joined by commas; they are left out of the map.
  std::string moving = "Car,Pedestrian,Bicyclist";
  UrbanGeometryOptions geometry;  ///< the vote of height and normal
  LabellerOptions labeller;       ///< the labels of superpixels
  void check() const;
};
void visit(OptionVisitor& field, StreetLabellingOptions& options);

/// Which pixels labels of surfaces keep out of tracking, place cues and the ground plane.
///
/// A label counts where its probability reaches the least one; other pixels are used as they are.
struct SceneMaskOptions {
  bool sky = true;          ///< mask the sky
  bool moving = true;       ///< mask what may move: cars, people, bicycles
  bool ground = true;       ///< align the ground plane only where there is ground
  double min_sky = 0.9;     ///< least probability of sky; overexposed walls are below it
  double min_moving = 0.6;  ///< least probability of what may move
  double min_ground = 0.5;  ///< least probability of ground
  int margin_px = 4;        ///< what may move is enlarged by this, as its contour moves too
  double min_share = 0.25;  ///< no mask is used if it leaves a smaller share of the image
  void check() const;
};
void visit(OptionVisitor& field, SceneMaskOptions& options);

/// Filter of the kind of environment over consecutive keyframes (hidden Markov model).
struct EnvironmentFilterOptions {
  double stay = 0.97;     ///< probability that the next keyframe is in the same kind
  double evidence = 0.5;  ///< exponent on a keyframe's probabilities: neighbours err alike
  double enter = 0.8;     ///< probability from which a kind is accepted
  double leave = 0.4;     ///< probability below which the accepted kind is given up
  int min_views = 3;      ///< keyframes before a kind is accepted
  void check() const;
};
void visit(OptionVisitor& field, EnvironmentFilterOptions& options);

}  // namespace placegraph
