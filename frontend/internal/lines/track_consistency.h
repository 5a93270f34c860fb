#pragma once
#include <placegraph/frontend/internal/lines/line_triangulation.h>

#include <vector>

namespace placegraph {

struct TrackConsistency {
  bool judged = false;       ///< false: its planes hardly turned, any association would do
  std::vector<bool> of_one;  ///< per sighting: sees the line that most of them see
  int wrong() const;         ///< sightings of other lines
};

/// Which sightings of a track see one and the same line of a static scene, poses exact: the line
/// through the planes of two sightings that most others see within `max_error_px` at both carriers,
/// before them. Pairs are taken from at most `kept` sightings, evenly spaced. All count as of one
/// where fewer than three or no two planes that turn by 0.05 degrees are there.
[[nodiscard]] TrackConsistency judge_line_track(const Camera& camera,
                                                const std::vector<LineMeasurement>& observations,
                                                double max_error_px = 3, int kept = 12);

}  // namespace placegraph
