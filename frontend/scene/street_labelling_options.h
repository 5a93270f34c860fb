#pragma once
#include <placegraph/frontend/labels/label_options.h>
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

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
