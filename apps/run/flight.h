#pragma once
#include <placegraph/graph/internal/measurements/marker_layout.h>
#include <placegraph/io/internal/datasets/euroc.h>
#include <placegraph/pipeline/internal/flight/flight_run.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct FlightArguments {
  std::string flight, out;            ///< folder in EuRoC's layout, and that of the results
  std::string markers;                ///< layout of the markers; empty: markers.yaml in `flight`
  std::string true_markers;           ///< layout that mapped markers are judged by; empty: none
  std::string config;                 ///< YAML file with options; empty: none
  std::vector<std::string> settings;  ///< "key=value"
  std::vector<std::string> blind;     ///< "FROM:TO" [s]: markers are not looked for
  std::optional<double> markers_until_s;  ///< nor from then on
  double predict_ahead_ms = 0;            ///< states are told so long after their image
  bool no_markers = false, start_from_truth = false, smooth = false, map_markers = false;
  bool force = false;  ///< write into a folder that is not empty
};

/// What a flight is told from, and judged by.
struct Flight {
  EurocBody body;
  ImuRecording imu;
  FlightRunOptions options;
  MarkerLayout layout, true_layout;
  std::vector<BodyState> truth;  ///< empty: there is none
};

/// "FROM:TO". Throws ArgumentError.
TimeSpan parse_span(const std::string& text);

/// The options that the arguments ask for; the noise of the inertial sensor is the default of the
/// filter's. Throws ArgumentError.
FlightRunOptions flight_options(const FlightArguments& arguments, const ImuNoise& noise);

/// Reads all but the images. Throws ArgumentError, FileError.
Flight open_flight(const FlightArguments& arguments);

}  // namespace placegraph::apps
