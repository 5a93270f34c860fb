#pragma once
#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// A constant that is added to the stamps of an estimate, and what it would pair.
struct StampShift {
  double shift_s = 0;  ///< added to the estimate's stamps, to a tenth of the largest difference
  int pairs = 0;       ///< stamps that then have a partner
  int pairs_now = 0;   ///< stamps that have one without it
  int stamps = 0;      ///< those of the sparser of the two in the time that both then cover
};

/// The constant that would pair most stamps of two recordings whose stamps overlap in time.
///
/// Judged by stamps alone, not by motion. The histogram of the differences between stamps of both
/// has its maximum there; of constants that pair equally many (regular clocks fit again after
/// every spacing) it is the one nearest to zero. Nothing where no constant is clear: fewer pairs
/// than halfway between those of a random constant and all, or within four standard deviations of
/// a random constant's; nothing where the stamps pair clearly as they are, where pairs may be
/// further apart than half a spacing, so that any constant pairs, and where the stamps do not
/// overlap (`other_clock` judges those). Rates may differ. Throws ArgumentError if stamps do not
/// increase or the largest difference is negative. Time O(n log n).
std::optional<StampShift> constant_shift_that_pairs(const std::vector<std::int64_t>& truth_ns,
                                                    const std::vector<std::int64_t>& estimate_ns,
                                                    double max_difference_s);

}  // namespace placegraph
