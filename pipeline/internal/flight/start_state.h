#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/internal/measurements/body_state.h>
#include <placegraph/graph/internal/measurements/sighting.h>
#include <placegraph/pipeline/internal/flight/flight_options.h>

#include <optional>

namespace placegraph {

/// The state of a body of which markers tell the pose: velocity zero, as uncertain as the options
/// say, and so are the biases, unless `before`, an earlier estimate for the same time, knows them:
/// then its biases and their covariance are kept.
BodyState start_state(const PoseMeasurement& pose, const FlightInitializationOptions& options,
                      const std::optional<BodyState>& before = std::nullopt);

}  // namespace placegraph
