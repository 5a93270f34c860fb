#pragma once
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>

#include "apps/run/run.h"

namespace placegraph::apps {

/// Makes the floor plan of a finished run, labels its places by the rooms and writes both into the
/// folder of the run; what result.json says of it. Where there is no plan the run is good all the
/// same.
nlohmann::json add_floor_plan(const RunArguments& arguments, const RunOptions& options,
                              const Dataset& dataset, RunResult& run);

/// Checks the models of a street map before any work. Throws FileError, ArgumentError.
void check_street_models(const RunOptions& options);

/// Writes the map of the street; what result.json says of it. Where there is none the run is good
/// all the same.
nlohmann::json add_street_map(const RunArguments& arguments, const RunOptions& options,
                              const Dataset& dataset, const RunResult& run);

}  // namespace placegraph::apps
