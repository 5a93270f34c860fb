#pragma once
#include <placegraph/frontend/labels/label_options.h>
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Use of height above ground and surface normal for the class of a superpixel.
struct StreetGeometryOptions {
  double outliers = 0.05;  ///< share of superpixels whose geometry does not depend on their class
  double weight = 1;       ///< weight of height and normal in the random field; 0: not used
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, StreetGeometryOptions& options);

/// Contribution of a stereo keyframe to a street map.
struct StreetLabellingOptions {
  int step_px = 6;          ///< distance of neighbouring points in the image
  double max_range_m = 40;  ///< farther points are not used
  /// Classes that move, joined by commas; they are left out of the map.
  std::string moving = "Car,Pedestrian,Bicyclist";
  StreetGeometryOptions geometry;  ///< use of height and normal
  LabellerOptions labeller;        ///< labelling of superpixels
  void check() const;
};
void visit(OptionVisitor& field, StreetLabellingOptions& options);

}  // namespace placegraph
