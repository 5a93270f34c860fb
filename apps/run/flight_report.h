#pragma once
#include <placegraph/pipeline/internal/flight/flight_run.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// The states of the frames that have one.
std::vector<BodyState> answers_of(const FlightRun& run);

/// What result.json says of the frames of a flight: how many were answered and by what, the times
/// between markers, the stages. `first_ns` is the time of the first image.
nlohmann::json describe_flight(const FlightRun& run, std::int64_t first_ns);

/// The errors of states, or why there are none.
nlohmann::json describe_error(const std::vector<BodyState>& truth,
                              const std::vector<BodyState>& states);

/// The smoother's error, and how much larger the filter's is over the same images.
nlohmann::json describe_smoother(const std::vector<BodyState>& truth, const FlightRun& run,
                                 const std::vector<BodyState>& smoothed);

/// The error of what comes after the last marker: drift, over the way flown since; null where that
/// are fewer than two states.
nlohmann::json describe_drift(const std::vector<BodyState>& truth, const FlightRun& run);

/// A line an image: what was measured in it, and how sure its state is.
std::string frames_csv(const FlightRun& run);

}  // namespace placegraph::apps
