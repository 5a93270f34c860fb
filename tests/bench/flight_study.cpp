// What the flight pipeline makes of flights without images: points of the floor, corners of markers
// and beacons are measured where they truly are, with noise. Consistency over many seeds, and drift
// after the last marker.
#include <fmt/format.h>
#include <placegraph/eval/trajectory/body_state_error.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/support/scenes/flight_measurements.h"

namespace placegraph {
namespace {

constexpr double kDuration_s = 120, kMarkersUntil_s = 3;

std::vector<BodyState> predictions(const std::vector<FlightFrame>& frames) {
  std::vector<BodyState> states;
  for (const FlightFrame& frame : frames)
    if (frame.outcome) states.push_back(frame.state);
  return states;
}

void study(int flights) {
  std::vector<double> all, position, velocity, attitude, position_m, velocity_mps, drift;
  for (int seed = 1; seed <= flights; ++seed) {
    synthetic::TourRequest request;
    request.seed = static_cast<std::uint64_t>(seed);
    request.duration_s = kDuration_s;
    const synthetic::Tour tour = synthetic::make_flight_world(request);
    const auto& truth = tour.flight_setting->flight.truth;
    const auto fly = [&](double until_s) {
      return body_state_error(
          truth, predictions(test::fly_without_images(
                     tour, {}, {}, request.seed, [until_s](double t) { return t < until_s; })));
    };
    const BodyStateError error = fly(kDuration_s + 1), blind = fly(kMarkersUntil_s);
    all.push_back(error.anees);
    position.push_back(error.anees_position);
    velocity.push_back(error.anees_velocity);
    attitude.push_back(error.anees_attitude);
    position_m.push_back(error.position_rmse_m);
    velocity_mps.push_back(error.velocity_rmse_mps);
    drift.push_back(100 * blind.end_error_m / blind.path_length_m);
  }
  const auto tell = [](const char* what, const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    fmt::print("{}\t{:.4g}\t{:.4g}\t{:.4g}\n", what, sum / static_cast<double>(values.size()),
               *least, *most);
  };
  fmt::print("figure\tmean\tleast\tmost\n");
  tell("anees", all);
  tell("anees_position", position);
  tell("anees_velocity", velocity);
  tell("anees_attitude", attitude);
  tell("position_rmse_m", position_m);
  tell("velocity_rmse_mps", velocity_mps);
  tell("drift_percent", drift);
}

}  // namespace
}  // namespace placegraph

int main(int argc, char** argv) {
  const int flights = argc > 1 ? std::atoi(argv[1]) : 50;
  if (flights < 1) {
    std::fprintf(stderr, "usage: bench_flight_study [FLIGHTS=50]\n");
    return 2;
  }
  placegraph::study(flights);
  return 0;
}
