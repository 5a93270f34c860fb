#pragma once
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/io/datasets/euroc.h>
#include <placegraph/pipeline/flight/flight_run.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct FlightArguments {
  std::string flight, out;   ///< folder in EuRoC's layout, and folder for the results
  std::string markers;       ///< file of the marker layout; empty: markers.yaml in `flight`
  std::string true_markers;  ///< true layout, to evaluate mapped markers; empty: none
  std::string config;        ///< YAML file with options; empty: none
  std::vector<std::string> settings;      ///< "key=value"
  std::vector<std::string> blind;         ///< intervals without markers, "FROM:TO" [s]
  std::optional<double> markers_until_s;  ///< markers are used before this time only [s]
  double predict_ahead_ms = 0;            ///< states are predicted this long after their image [ms]
  bool no_markers = false, start_from_truth = false, smooth = false, map_markers = false;
  bool force = false;  ///< write into a folder that is not empty
};

/// Input data and ground truth of a flight.
struct Flight {
  EurocBody body;
  ImuRecording imu;
  FlightRunOptions options;
  MarkerLayout layout, true_layout;
  std::vector<BodyState> truth;  ///< true states; empty: unknown
};

/// Parses "FROM:TO". Throws ArgumentError.
TimeSpan parse_span(const std::string& text);

/// Options for the arguments.
/// The noise of the inertial sensor is the default of the filter's. Throws ArgumentError.
FlightRunOptions flight_options(const FlightArguments& arguments, const ImuNoise& noise);

/// Reads all input data except the images. Throws ArgumentError, FileError.
Flight open_flight(const FlightArguments& arguments);

}  // namespace placegraph::apps
