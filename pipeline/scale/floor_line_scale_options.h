#pragma once
#include <placegraph/frontend/lines/floor_from_lines.h>

namespace placegraph {

struct FloorScaleOptions {
  FloorFromLinesOptions floor;
  double sigma_relative = 0.01;      ///< of a single height: the floor is not flat, the camera bobs
  double max_log_jump = 0.12;        ///< from the median of the last scales; more is not believed
  double max_sigma_at_first = 0.04;  ///< of the height that gives the unit, relative
  void check() const;
};
void visit(OptionVisitor& field, FloorScaleOptions& options);

}  // namespace placegraph
