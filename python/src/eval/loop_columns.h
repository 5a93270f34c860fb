#pragma once
#include <placegraph/graph/recognition/loop_prediction.h>

#include <vector>

#include "python/src/arrays.h"

namespace placegraph::python {

/// Columns query, candidate and score of predictions.
Table columns_of(const std::vector<LoopPrediction>& predictions);

}  // namespace placegraph::python
