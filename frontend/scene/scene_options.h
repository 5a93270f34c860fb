#pragma once
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Orientations of surfaces in a single image by line sweeping (Lee, Hebert & Kanade 2009).
struct OrientationMapOptions {
  double cell_px = 3;      ///< side of the cells of the raster that lines are swept over
  double max_sweep = 0.6;  ///< longest sweep of an edge [image widths]
  double min_margin = 2;   ///< minimum ratio of the support of the best to the second orientation
  double min_confidence = 0.1;  ///< pixels of less confidence (0 to 1) get no orientation
  int smoothing_cells = 2;      ///< radius of the vote among neighbouring cells; 0: none
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, OrientationMapOptions& options);

/// Test whether another image sees through a point, so that the point is not on a surface.
struct SeenThroughOptions {
  double min_disparity_px = 2;  ///< minimum disparity between the point and the surface behind it
  int radius_px = 2;            ///< radius within which all depths must be farther
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SeenThroughOptions& options);

/// Use of height above ground and surface normal for the class of a superpixel.
struct UrbanGeometryOptions {
  double disparity_sigma_px = 0.25;  ///< minimum standard deviation of the disparity of one pixel
  double ground_sigma_m = 0.03;      ///< unevenness of the ground at the camera
  double ground_sigma_rate = 0.004;  ///< increase of that unevenness per metre of distance [m/m]
  double outliers = 0.05;  ///< share of superpixels whose geometry does not depend on their class
  double weight = 1;       ///< weight of height and normal in the random field; 0: not used
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, UrbanGeometryOptions& options);

/// Parts of a model that are used to label the superpixels of an image.
struct LabellerOptions {
  bool context = true;  ///< whether a second forest uses the labels of neighbouring superpixels
  bool field = true;    ///< whether a random field favours equal labels for similar neighbours
  /// Whether the field uses its table of the classes above and beside each class. Off, because the
  /// second forest uses the same evidence, which would count twice.
  bool relations = false;
  int rounds = 2;  ///< number of applications of the second forest
  void check() const;
};
void visit(OptionVisitor& field, LabellerOptions& options);

/// Contribution of a stereo keyframe to the semantic map of a street.
struct StreetLabellingOptions {
  int step_px = 6;          ///< distance of neighbouring points in the image
  double max_range_m = 40;  ///< farther points are not used
  /// Maximum distance of a disparity from its superpixel's plane, in standard deviations.
  double max_residual = 3;
  /// Classes that move, joined by commas; they are left out of the map.
  std::string moving = "Car,Pedestrian,Bicyclist";
  UrbanGeometryOptions geometry;  ///< use of height and normal
  LabellerOptions labeller;       ///< labelling of superpixels
  void check() const;
};
void visit(OptionVisitor& field, StreetLabellingOptions& options);

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
  double stay = 0.97;  ///< probability that the next keyframe is in the same kind
  /// Exponent on a keyframe's probabilities, as the errors of neighbours are correlated.
  double evidence = 0.5;
  double enter = 0.8;  ///< probability from which a kind is accepted
  double leave = 0.4;  ///< probability below which the accepted kind is dropped
  int min_views = 3;   ///< number of keyframes before a kind is accepted
  void check() const;
};
void visit(OptionVisitor& field, EnvironmentFilterOptions& options);

}  // namespace placegraph
