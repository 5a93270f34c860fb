#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/loop_prediction.h>
#include <placegraph/graph/map.h>

#include <vector>

namespace placegraph {

struct MapRevisitOptions {
  int min_age = 300;          ///< frames between the two, at least
  double max_angle_deg = 30;  ///< between where they look
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, MapRevisitOptions& options);

/// Where every frame of a finished map was before: of the older frames in its own place or in one
/// next to it (by a constraint or by a way the camera went) that look the same way, the nearest one
/// by the map's poses. The score is less the farther that is, 1 / (1 + distance in the map's unit):
/// what the map does not join by a place is no revisit, however near its poses lie. Frames without
/// such an older one, lost ones and those of other components than the first are left out. Throws
/// ArgumentError as Map::trajectory_optimized.
std::vector<LoopPrediction> map_revisits(const Map& map, const MapRevisitOptions& options = {});

}  // namespace placegraph
