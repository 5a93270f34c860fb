#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/pipeline/flight/flight_options.h>

#include <optional>

namespace placegraph {

/// Initial state of a body whose pose is given by markers. Velocity and biases are zero with the
/// uncertainty of the options; if `before`, an earlier estimate for the same time, is given, its
/// biases and their covariance are kept.
BodyState start_state(const PoseMeasurement& pose, const FlightInitializationOptions& options,
                      const std::optional<BodyState>& before = std::nullopt);

}  // namespace placegraph
