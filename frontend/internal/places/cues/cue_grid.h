#pragma once
#include <placegraph/graph/place_view.h>

#include <vector>

namespace placegraph {

/// The grid of `values` (columns * rows * channels), rounded to 11 bits of the largest. Throws
/// ArgumentError if their number is another or one is not finite.
CueGrid make_cue_grid(int columns, int rows, int channels, const std::vector<float>& values);

/// Which shifts of one grid over the other are tried, their centres together at first.
struct GridSearch {
  int shift_x = 0, shift_y = 0;  ///< cells, to either side
  int step = 1;                  ///< between the shifts tried first; then those beside the best
  double loss = 0;               ///< of similarity where all of the candidate lies outside
  double min_overlap = 0.35;     ///< share of the candidate's cells
};

/// The largest cosine between what overlaps of two grids, less `loss` times the share of the
/// candidate that does not, over all shifts. The grids may differ in size (the query seen at
/// another scale), not in channels (ArgumentError). -1 where no shift overlaps enough; 0 for a part
/// without any length.
double best_alignment(const CueGrid& query, const CueGrid& candidate, const GridSearch& search);

}  // namespace placegraph
