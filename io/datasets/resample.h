#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The poses at `stamps_ns`, interpolated in a recording with another clock rate.
/// The recording may be denser or sparser; frames without a pose within `max_gap_s` get none. The
/// warnings of its reader are kept.
Trajectory resample(const Trajectory& recorded, const std::vector<std::int64_t>& stamps_ns,
                    double max_gap_s);

}  // namespace placegraph
