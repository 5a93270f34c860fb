#pragma once
#include <cstdint>
#include <vector>

namespace placegraph {

/// The spacing at which stamps come where none is missing; 0 for less than two.
///
/// The fixed point of "median of the spacings up to 1.5 times it", from their lower decile on. Stamps
/// that are lost at random double, treble ... spacings; up to 85 % of them do not move it, nor does
/// jitter of a third of a spacing. The median of all doubles where more than half are lost.
double nominal_spacing_ns(const std::vector<std::int64_t>& stamps_ns);

}  // namespace placegraph
