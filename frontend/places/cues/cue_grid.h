#pragma once
#include <placegraph/graph/recognition/place_view.h>

#include <vector>

namespace placegraph {

/// Makes the grid of `values` (columns * rows * channels), rounded to 11 bits of the largest.
///
/// Throws ArgumentError for another number of values or a value that is not finite.
CueGrid make_cue_grid(int columns, int rows, int channels, const std::vector<float>& values);

/// Range of the shifts of one grid over the other; a shift of 0 puts their centres together.
struct GridSearch {
  int shift_x = 0, shift_y = 0;  ///< maximum shift to either side [cells]
  int step = 1;  ///< step between the first shifts; afterwards those beside the best one are tried
  double loss = 0;            ///< loss of similarity if all of the candidate is outside
  double min_overlap = 0.35;  ///< minimum share of the candidate's cells that overlap
};

/// Largest cosine between the overlapping parts of two grids, over all shifts.
///
/// `loss` times the share of the candidate that does not overlap is subtracted. The grids may
/// differ in size (for a query at another scale), but not in channels (ArgumentError). The result
/// is -1 if no shift overlaps enough; a part of length zero has cosine 0.
double best_alignment(const CueGrid& query, const CueGrid& candidate, const GridSearch& search);

}  // namespace placegraph
