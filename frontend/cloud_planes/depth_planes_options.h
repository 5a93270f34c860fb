#pragma once
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct DepthPlanesOptions {
  int cell_px = 8;           ///< side of the cells that planes are grown over
  int step_px = 2;           ///< between the pixels that are looked at
  double flatness = 0.002;   ///< what a plane may bend, as a share of the depth
  double min_share = 0.02;   ///< of the image's cells, for a plane
  int max_planes = 8;        ///< the largest
  double max_sigma_deg = 1;  ///< of the normal, to be of use
  /// What all planes of a camera may be off by beyond what their residuals tell: its depths are
  /// bent and scaled, which a plane follows.
  double floor_deg = 0.1;
  double floor_distance = 0.002;  ///< as a share of the distance
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DepthPlanesOptions& options);

}  // namespace placegraph
