#pragma once
#include <placegraph/frontend/labels/label_options.h>
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

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

/// Test whether another image sees through a point, so that the point is not on a surface.
struct SeenThroughOptions {
  double min_disparity_px = 2;  ///< minimum disparity between the point and the surface behind it
  int radius_px = 2;            ///< radius within which all depths must be farther
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SeenThroughOptions& options);

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

}  // namespace placegraph
