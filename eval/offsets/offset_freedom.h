#pragma once
#include <placegraph/eval/offsets/offset_estimation.h>
#include <placegraph/eval/offsets/offset_fit.h>

#include <vector>

namespace placegraph {

/// Turns a change in the tangent of a fit into one along and about the axes of the estimate's body.
OffsetMatrix to_estimate_axes(const OffsetFit& fit, bool has_rotation);

/// Infinity for parameters that a free direction moves clearly, else 0; `turn` as above.
OffsetVector moved_by_free(const OffsetFit& fit, const OffsetMatrix& turn);

/// The free directions of what is asked for, with their names: those of the lever arm alone first,
/// then those of the rotation, of the time, and what only both together leave free.
std::vector<FreeOffset> free_offsets(const OffsetFit& fit, const OffsetOptions& options,
                                     bool has_rotation);

}  // namespace placegraph
