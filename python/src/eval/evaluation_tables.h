#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

#include "python/src/arrays.h"

namespace placegraph::python {

/// Columns of the evaluated frames.
Table frame_table(const EvaluationResult& result);

/// Columns of the means over segments of one length, or of one interval of speed.
Table group_table(const std::vector<SegmentGroup>& groups);

/// Columns of the segments of t_rel and r_rel.
Table segment_table(const EvaluationResult& result);

/// Statistics of every kind of error, a row each.
Table error_table(const EvaluationResult& result);

/// The steps over a delta as it was asked for; "1f" is always there.
Table steps_over(const EvaluationResult& result, const std::string& delta);

/// Errors by intervals of "speed", "turning_rate" or "distance".
Table profile_table(const EvaluationResult& result, const std::string& by);

/// The stretches with the largest errors, of positions or of steps.
Table worst_table(const std::vector<WorstStretch>& stretches);

}  // namespace placegraph::python
