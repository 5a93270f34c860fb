#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/recognition/loop_prediction.h>

#include <vector>

namespace placegraph {

struct MapRevisitOptions {
  int min_age = 300;          ///< minimum number of frames between the two
  double max_angle_deg = 30;  ///< largest angle between the two viewing directions [deg]
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, MapRevisitOptions& options);

/// Finds for every frame of a finished map an earlier frame at the same place.
/// Candidates are older frames in the frame's own place or in an adjacent one (by a constraint or
/// by a transition of the camera) with a similar viewing direction; the result is the nearest
/// candidate by the map's poses. The score decreases with the distance, 1 / (1 + distance in the
/// map's unit). Nearby poses without a common or adjacent place are no revisit. Frames without such
/// a candidate, lost frames and frames of other components than the first are left out. Throws
/// ArgumentError as Map::trajectory_optimized.
std::vector<LoopPrediction> map_revisits(const Map& map, const MapRevisitOptions& options = {});

}  // namespace placegraph
