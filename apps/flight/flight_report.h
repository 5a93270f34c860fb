#pragma once
#include <placegraph/pipeline/flight/flight_run.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// States of all frames that have one.
std::vector<BodyState> estimated_states(const FlightRun& run);

/// Members of result.json for the frames of a flight.
/// These are the numbers of frames by kind of measurement, the times between markers, and the
/// stages. `first_ns` is the time of the first image.
nlohmann::json describe_flight(const FlightRun& run, std::int64_t first_ns);

/// Errors of states, or the reason why there are none.
nlohmann::json describe_error(const std::vector<BodyState>& truth,
                              const std::vector<BodyState>& states);

/// Error of the smoother, and the ratio of the filter's error to it over the same images.
nlohmann::json describe_smoother(const std::vector<BodyState>& truth, const FlightRun& run,
                                 const std::vector<BodyState>& smoothed);

/// Drift after the last marker, over the path length since; null with fewer than two states.
nlohmann::json describe_drift(const std::vector<BodyState>& truth, const FlightRun& run);

/// One line per image: its measurements, and the standard deviations of its state.
std::string frames_csv(const FlightRun& run);

}  // namespace placegraph::apps
