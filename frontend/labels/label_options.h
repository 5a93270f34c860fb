#pragma once
#include <placegraph/graph/core/options.h>

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

}  // namespace placegraph
