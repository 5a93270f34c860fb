#include "apps/flight/flight.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/measurements/marker_layout_file.h>
#include <placegraph/io/trajectories/body_state_file.h>

#include <filesystem>

#include "apps/shipped/shipped_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// The true state with standard deviations smaller than those of any recorded truth; the filter
/// corrects the rest.
BodyState with_small_covariance(BodyState state) {
  Eigen::Matrix<double, 15, 1> sigma;
  sigma << Eigen::Vector3d::Constant(1e-3), Eigen::Vector3d::Constant(1e-2),
      Eigen::Vector3d::Constant(1e-3), Eigen::Vector3d::Constant(1e-3),
      Eigen::Vector3d::Constant(1e-2);
  state.covariance = sigma.cwiseAbs2().asDiagonal();
  return state;
}

}  // namespace

TimeSpan parse_span(const std::string& text) {
  const auto colon = text.find(':');
  TimeSpan span;
  try {
    std::size_t used_from = 0, used_to = 0;
    const std::string from = text.substr(0, colon);
    const std::string to = colon == std::string::npos ? "" : text.substr(colon + 1);
    span = {std::stod(from, &used_from), std::stod(to, &used_to)};
    if (used_from == from.size() && used_to == to.size() && span.from_s < span.to_s) return span;
  } catch (const std::exception&) {
  }
  throw ArgumentError("--blind: '" + text + "' is not of the form FROM:TO in seconds");
}

FlightRunOptions flight_options(const FlightArguments& arguments, const ImuNoise& noise) {
  FlightRunOptions options;
  ErrorStateFilterOptions& filter = options.flight.filter;
  filter.gyro_noise = noise.gyro;
  filter.accel_noise = noise.accel;
  filter.gyro_bias_walk = noise.gyro_bias_walk;
  filter.accel_bias_walk = noise.accel_bias_walk;
  const LogSink notes = option_notes();
  if (!arguments.config.empty()) read_options(config_path(arguments.config), options.flight, notes);
  for (const std::string& setting : arguments.settings) set_option(options.flight, setting, notes);
  options.flight.check();
  constexpr double kForever_s = 1e12;
  for (const std::string& text : arguments.blind) options.blind.push_back(parse_span(text));
  if (arguments.markers_until_s) {
    require(*arguments.markers_until_s > 0, "--markers-until: must be positive");
    options.blind.push_back({*arguments.markers_until_s, kForever_s});
  }
  if (arguments.no_markers) options.blind = {{-kForever_s, kForever_s}};
  options.predict_ahead_s = 1e-3 * arguments.predict_ahead_ms;
  require(!arguments.smooth || arguments.predict_ahead_ms == 0,
          "--smooth: predicted states cannot be smoothed");
  require(options.predict_ahead_s >= 0 && options.predict_ahead_s <= filter.max_prediction_s,
          fmt::format("--predict-ahead-ms: {} is not within 0 and filter.max_prediction_s = {} s",
                      arguments.predict_ahead_ms, filter.max_prediction_s));
  return options;
}

Flight open_flight(const FlightArguments& arguments) {
  require(is_euroc(arguments.flight),
          arguments.flight + ": is no folder with mav0/cam0/data.csv (EuRoC's layout)");
  Flight flight{open_euroc_body(arguments.flight), {}, {}, {}, {}, {}};
  flight.imu = read_imu(flight.body.mav_folder + "/imu0");
  flight.options = flight_options(arguments, flight.imu.noise);
  const std::string beside = (fs::path(arguments.flight) / "markers.yaml").string();
  if (!arguments.no_markers)
    flight.layout = read_marker_layout(arguments.markers.empty() ? beside : arguments.markers);
  require(!arguments.map_markers || !flight.layout.unplaced_sides_m.empty(),
          "--map-markers: the layout has the pose of every marker");
  require(!arguments.map_markers || arguments.predict_ahead_ms == 0,
          "--map-markers: cannot be combined with --predict-ahead-ms");
  const double length_s =
      1e-9 * static_cast<double>(flight.body.images->stamp_ns(flight.body.images->size() - 1) -
                                 flight.body.images->stamp_ns(0));
  for (const std::string& text : arguments.blind)
    require(
        parse_span(text).from_s <= length_s,
        fmt::format("--blind: {} begins after the flight, which lasts {:.3f} s", text, length_s));
  if (!arguments.true_markers.empty())
    flight.true_layout = read_marker_layout(arguments.true_markers);
  const std::string truth = flight.body.mav_folder + "/state_groundtruth_estimate0/data.csv";
  if (fs::exists(truth)) flight.truth = read_body_states(truth, messages());
  if (arguments.start_from_truth) {
    require(!flight.truth.empty(), "--start-from-truth: there is no " + truth);
    flight.options.initial_state = with_small_covariance(flight.truth.front());
  }
  return flight;
}

}  // namespace placegraph::apps
