#include "apps/run/cmd_flight.h"

#include <fmt/format.h>
#include <placegraph/eval/trajectory/body_state_error.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/euroc.h>
#include <placegraph/io/measurements/marker_layout_file.h>
#include <placegraph/io/trajectories/body_state_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/flight/flight_marker_map.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/run/hover_map_report.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct HoverArguments {
  std::string flight, out, markers, true_markers, config;
  std::vector<std::string> settings, blind;
  std::optional<double> markers_until_s;
  double predict_ahead_ms = 0;
  bool no_markers = false, start_from_truth = false, smooth = false, map_markers = false;
  bool as_json = false, force = false, profile = false;
};

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

HoverRunOptions options_of(const HoverArguments& arguments, const ImuNoise& noise) {
  HoverRunOptions options;
  PositionFilterOptions& filter = options.hover.filter;
  filter.gyro_noise = noise.gyro;
  filter.accel_noise = noise.accel;
  filter.gyro_bias_walk = noise.gyro_bias_walk;
  filter.accel_bias_walk = noise.accel_bias_walk;
  if (!arguments.config.empty()) read_options(arguments.config, options.hover);
  for (const std::string& setting : arguments.settings) set_option(options.hover, setting);
  options.hover.check();
  constexpr double kForever_s = 1e12;
  for (const std::string& text : arguments.blind) options.blind.push_back(parse_span(text));
  if (arguments.markers_until_s) {
    require(*arguments.markers_until_s > 0, "--markers-until: must be positive");
    options.blind.push_back({*arguments.markers_until_s, kForever_s});
  }
  if (arguments.no_markers) options.blind = {{-kForever_s, kForever_s}};
  options.predict_ahead_s = 1e-3 * arguments.predict_ahead_ms;
  require(!arguments.smooth || arguments.predict_ahead_ms == 0,
          "--smooth: what is told ahead is not smoothed");
  require(options.predict_ahead_s >= 0 && options.predict_ahead_s <= filter.max_prediction_s,
          fmt::format("--predict-ahead-ms: {} is not within 0 and filter.max_prediction_s = {} s",
                      arguments.predict_ahead_ms, filter.max_prediction_s));
  return options;
}

/// As sure as nothing of a recorded truth is: the filter learns the rest.
BodyState surely(BodyState state) {
  Eigen::Matrix<double, 15, 1> sigma;
  sigma << Eigen::Vector3d::Constant(1e-3), Eigen::Vector3d::Constant(1e-2),
      Eigen::Vector3d::Constant(1e-3), Eigen::Vector3d::Constant(1e-3),
      Eigen::Vector3d::Constant(1e-2);
  state.covariance = sigma.cwiseAbs2().asDiagonal();
  return state;
}

Trajectory trajectory_of(const HoverRun& run) {
  Trajectory trajectory;
  for (const HoverFrame& frame : run.frames) {
    trajectory.poses.push_back({frame.state.stamp_ns, std::nullopt});
    if (!frame.outcome) trajectory.poses.back().stamp_ns = frame.stamp_ns;
    if (frame.outcome) trajectory.poses.back().T_world_body = frame.state.T_world_body.isometry();
  }
  return trajectory;
}

std::vector<BodyState> answers_of(const HoverRun& run) {
  std::vector<BodyState> states;
  for (const HoverFrame& frame : run.frames)
    if (frame.outcome) states.push_back(frame.state);
  return states;
}

json describe_error(const std::vector<BodyState>& truth, const std::vector<BodyState>& states) {
  const BodyStateError error = body_state_error(truth, states);
  if (error.compared == 0) return {{"refused", error.outcome.reason}};
  const auto number = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  return {{"compared", error.compared},
          {"position_rmse_m", error.position_rmse_m},
          {"position_max_m", error.position_max_m},
          {"velocity_rmse_mps", error.velocity_rmse_mps},
          {"attitude_rmse_deg", rad_to_deg(error.attitude_rmse_rad)},
          {"end_error_m", error.end_error_m},
          {"way_m", error.way_m},
          {"anees", number(error.anees)},
          {"anees_position", number(error.anees_position)},
          {"anees_velocity", number(error.anees_velocity)},
          {"anees_attitude", number(error.anees_attitude)}};
}

/// The smoother's error, and how much larger the filter's is over the same images.
json describe_smoother(const std::vector<BodyState>& truth, const HoverRun& run,
                       const std::vector<BodyState>& smoothed) {
  json smoother = describe_error(truth, smoothed);
  std::vector<BodyState> filtered = answers_of(run);
  std::erase_if(filtered, [&](const BodyState& state) {
    return smoothed.empty() || state.stamp_ns < smoothed.front().stamp_ns;
  });
  const BodyStateError filter = body_state_error(truth, filtered);
  if (filter.compared > 0 && smoother.contains("position_rmse_m"))
    smoother["filter_over_smoother"] =
        filter.position_rmse_m / smoother["position_rmse_m"].get<double>();
  return smoother;
}

/// The error of what comes after the last marker: drift, over the way flown since.
json describe_drift(const std::vector<BodyState>& truth, const HoverRun& run) {
  std::vector<BodyState> since;
  for (const HoverFrame& frame : run.frames) {
    if (frame.markers) since.clear();
    if (frame.outcome) since.push_back(frame.state);
  }
  const BodyStateError error = body_state_error(truth, since);
  if (error.compared < 2) return nullptr;
  return {{"seconds", 1e-9 * static_cast<double>(since.back().stamp_ns - since.front().stamp_ns)},
          {"way_m", error.way_m},
          {"end_error_m", error.end_error_m},
          {"percent", 100 * error.end_error_m / error.way_m}};
}

/// Times between believed markers, from one second on.
std::vector<double> outages_of(const HoverRun& run) {
  std::vector<double> outages;
  std::int64_t last_ns = -1;
  for (const HoverFrame& frame : run.frames) {
    if (!frame.markers) continue;
    const double gap_s = 1e-9 * static_cast<double>(frame.stamp_ns - last_ns);
    if (last_ns >= 0 && gap_s >= 1) outages.push_back(gap_s);
    last_ns = frame.stamp_ns;
  }
  return outages;
}

json describe(const HoverRun& run, std::int64_t first_ns) {
  json lost = json::array(), stages = json::array();
  int with_flow = 0, with_markers = 0;
  std::optional<double> start_s;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const HoverFrame& frame = run.frames[i];
    if (!frame.outcome) lost.push_back(i);
    if (frame.outcome && !start_s) start_s = 1e-9 * static_cast<double>(frame.stamp_ns - first_ns);
    with_flow += static_cast<bool>(frame.flow);
    with_markers += static_cast<bool>(frame.markers);
  }
  for (const StageTimes::Stage& stage : run.stages)
    stages.push_back({{"name", stage.name}, {"cpu_s", stage.cpu_s}, {"calls", stage.calls}});
  const std::vector<double> outages = outages_of(run);
  const auto longest = std::max_element(outages.begin(), outages.end());
  return {{"frames", run.frames.size()},
          {"answered", run.frames.size() - lost.size()},
          {"lost_frames", lost},
          {"start_s", start_s ? json(*start_s) : json()},
          {"frames_with_flow", with_flow},
          {"frames_with_markers", with_markers},
          {"outages_s", outages},
          {"outages_over_5s",
           std::count_if(outages.begin(), outages.end(), [](double gap_s) { return gap_s >= 5; })},
          {"longest_outage_s", longest == outages.end() ? 0.0 : *longest},
          {"stages", stages}};
}

std::string frames_csv(const HoverRun& run) {
  std::string text =
      "stamp_ns,answered,flow,flow_points,flow_chi2,markers,markers_seen,sigma_x_m,sigma_y_m,sigma_"
      "z_m,why\n";
  for (const HoverFrame& frame : run.frames) {
    const Eigen::Vector3d sigma = frame.state.covariance.diagonal().head<3>().cwiseSqrt();
    text += fmt::format("{},{:d},{:d},{},{:.3f},{:d},{},{:.5f},{:.5f},{:.5f},{}\n", frame.stamp_ns,
                        static_cast<bool>(frame.outcome), static_cast<bool>(frame.flow),
                        frame.flow_points, frame.flow_chi2, static_cast<bool>(frame.markers),
                        frame.markers_seen, sigma.x(), sigma.y(), sigma.z(),
                        frame.outcome ? "" : frame.outcome.reason);
  }
  return text;
}

void print_flight_summary(const json& summary, const std::string& folder) {
  std::printf("%s: %d of %d frames answered, %d with flow, %d with markers\n",
              summary["sequence"].get<std::string>().c_str(), summary["answered"].get<int>(),
              summary["frames"].get<int>(), summary["frames_with_flow"].get<int>(),
              summary["frames_with_markers"].get<int>());
  if (summary.contains("error") && summary["error"].contains("position_rmse_m")) {
    const json& error = summary["error"];
    std::printf("position RMSE %.4f m, velocity %.4f m/s, attitude %.3f deg over %.1f m\n",
                error["position_rmse_m"].get<double>(), error["velocity_rmse_mps"].get<double>(),
                error["attitude_rmse_deg"].get<double>(), error["way_m"].get<double>());
  }
  if (summary.contains("marker_map"))
    std::printf("%s\n", marker_map_line(summary["marker_map"]).c_str());
  std::printf(
      "%.2f ms CPU a frame (%.2f of them reading), results in %s\n",
      summary["cpu_ms_per_frame"].get<double>() + summary["reading_ms_per_frame"].get<double>(),
      summary["reading_ms_per_frame"].get<double>(), folder.c_str());
}

void print_flight_stages(const json& summary) {
  const double frames = summary["frames"].get<double>();
  std::printf("%-16s %9s %13s\n", "stage", "calls", "CPU ms/frame");
  for (const json& stage : summary["stages"])
    std::printf("%-16s %9lld %13.3f\n", stage["name"].get<std::string>().c_str(),
                stage["calls"].get<long long>(), 1e3 * stage["cpu_s"].get<double>() / frames);
}

/// What a flight is told from, and judged by.
struct Flight {
  EurocBody body;
  ImuRecording imu;
  HoverRunOptions options;
  MarkerLayout layout, true_layout;
  std::vector<BodyState> truth;  ///< empty: there is none
};

Flight open_flight(const HoverArguments& arguments) {
  require(is_euroc(arguments.flight),
          arguments.flight + ": is no folder with mav0/cam0/data.csv (EuRoC's layout)");
  Flight flight{open_euroc_body(arguments.flight), {}, {}, {}, {}, {}};
  flight.imu = read_imu(flight.body.mav_folder + "/imu0");
  flight.options = options_of(arguments, flight.imu.noise);
  const std::string beside = (fs::path(arguments.flight) / "markers.yaml").string();
  if (!arguments.no_markers)
    flight.layout = read_marker_layout(arguments.markers.empty() ? beside : arguments.markers);
  require(!arguments.map_markers || !flight.layout.unplaced_sides_m.empty(),
          "--map-markers: the layout gives every marker its place");
  require(!arguments.map_markers || arguments.predict_ahead_ms == 0,
          "--map-markers: what is told ahead is not where an image was");
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
  if (fs::exists(truth)) flight.truth = read_body_states(truth);
  if (arguments.start_from_truth) {
    require(!flight.truth.empty(), "--start-from-truth: there is no " + truth);
    flight.options.start = surely(flight.truth.front());
  }
  return flight;
}

/// What came of it.
struct Flown {
  HoverRun run;
  std::vector<BodyState> smoothed;
  std::optional<MarkerMap> map;
  json summary;
};

Flown fly(const HoverArguments& arguments, const Flight& flight) {
  const EurocBody& body = flight.body;
  Flown flown;
  const Stopwatch watch;
  {
    Progress progress("hovering " + body.images->name(),
                      static_cast<std::int64_t>(body.images->size()));
    flown.run =
        run_hover(*body.images, flight.imu, body.T_body_cam, flight.layout, flight.options,
                  [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  }
  json& summary = flown.summary;
  summary = describe(flown.run, body.images->stamp_ns(0));
  const auto frames = static_cast<double>(flown.run.frames.size());
  const double reading_ms = 1e3 * flown.run.stages.front().cpu_s / frames;
  summary["sequence"] = body.images->name();
  summary["reading_ms_per_frame"] = reading_ms;
  summary["cpu_ms_per_frame"] = watch.cpu_ms() / frames - reading_ms;
  if (!flight.truth.empty()) {
    summary["error"] = describe_error(flight.truth, answers_of(flown.run));
    summary["drift"] = describe_drift(flight.truth, flown.run);
  }
  if (arguments.smooth) {
    const Stopwatch smoothing;
    flown.smoothed = smooth_hover(flown.run, flight.imu, body.T_body_cam, flight.options.hover);
    summary["smoother_cpu_ms_per_frame"] = smoothing.cpu_ms() / frames;
    if (!flight.truth.empty())
      summary["smoother"] = describe_smoother(flight.truth, flown.run, flown.smoothed);
  }
  if (arguments.map_markers) {
    flown.map = map_hover_markers(*body.images, flown.run, body.T_body_cam, flight.layout,
                                  flight.options.hover);
    summary["marker_map"] = describe_marker_map(*flown.map, flight.layout, flight.true_layout);
  }
  summary["peak_mb"] = peak_mb();
  return flown;
}

void write_results(const std::string& folder, const Flown& flown, const MarkerLayout& layout) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  for (const char* name : {"result.json", "smoothed.csv", "markers.yaml"})
    fs::remove(path(name));  // result.json is written last: it vouches for the others
  write_trajectory(path("trajectory.tum"), trajectory_of(flown.run), TrajectoryFormat::kTum);
  write_body_states(path("states.csv"), answers_of(flown.run));
  if (!flown.smoothed.empty()) write_body_states(path("smoothed.csv"), flown.smoothed);
  if (flown.map && flown.map->outcome)
    write_marker_layout(path("markers.yaml"), with_mapped(layout, *flown.map));
  write_file(path("frames.csv"), frames_csv(flown.run));
  write_file(path("result.json"), flown.summary.dump(1) + "\n");
}

void run(const HoverArguments& arguments) {
  require_free_folder(arguments.out, arguments.force);
  const Flight flight = open_flight(arguments);
  const OutputFolder folder(arguments.out);
  const Flown flown = fly(arguments, flight);
  write_results(arguments.out, flown, flight.layout);
  if (arguments.as_json)
    std::printf("%s\n", flown.summary.dump(1).c_str());
  else
    print_flight_summary(flown.summary, arguments.out);
  if (arguments.profile && !arguments.as_json) print_flight_stages(flown.summary);
  if (answers_of(flown.run).empty())
    throw NoAnswer(arguments.flight + ": no image could be told a state (" +
                   flown.run.frames.back().outcome.reason + ")");
  if (flown.map && !flown.map->outcome)
    throw NoAnswer(arguments.flight + ": no marker was mapped (" + flown.map->outcome.reason + ")");
}

}  // namespace

void add_hover_command(CLI::App& app) {
  auto arguments = std::make_shared<HoverArguments>();
  HoverArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "hover", "Where a flying robot was, by flow, inertial sensor and markers.");
  command->footer("placegraph hover out/flight --out out/hover");
  command->add_option("FLIGHT", a.flight, "folder in EuRoC's layout with imu0; see docs/hover.md")
      ->required();
  command->add_option("--out", a.out, "folder for the results")->required();
  command->add_option("--markers", a.markers,
                      "where markers and beacons are; default: FLIGHT/markers.yaml");
  auto* none = command->add_flag("--no-markers", a.no_markers, "never look for markers");
  command
      ->add_option("--markers-until", a.markers_until_s,
                   "look for markers for so many seconds only")
      ->excludes(none);
  command
      ->add_option("--blind", a.blind,
                   "FROM:TO, seconds in which markers are not looked for; may be repeated")
      ->allow_extra_args(false)
      ->excludes(none);
  auto* map = command->add_flag("--map-markers", a.map_markers,
                                "find where the markers are whose place the layout does not give; "
                                "OUT/markers.yaml has them all");
  map->excludes(none);
  command->add_option("--true-markers", a.true_markers, "layout that the mapped ones are judged by")
      ->check(CLI::ExistingFile)
      ->needs(map);
  command->add_flag("--start-from-truth", a.start_from_truth,
                    "begin with the first true state instead of the first marker");
  command
      ->add_option("--predict-ahead-ms", a.predict_ahead_ms,
                   "tell states so long after their image, by what came until then")
      ->capture_default_str();
  command->add_flag("--smooth", a.smooth,
                    "also the smoother's states: the same measurements in a window of a second");
  command->add_option("--config", a.config, "YAML file with options; see docs/hover.md");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "print result.json");
  command->add_flag("--profile", a.profile, "print the CPU time of every stage");
  command->add_flag("--force", a.force, "write into a folder that is not empty");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
