#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

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
