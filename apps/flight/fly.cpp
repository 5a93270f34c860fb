#include "apps/flight/fly.h"

#include <fmt/format.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/measurements/marker_layout_file.h>
#include <placegraph/io/trajectories/body_state_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/flight/flight_run.h>
#include <placegraph/pipeline/flight/marker_map.h>

#include <filesystem>

#include "apps/flight/flight_map_report.h"
#include "apps/flight/flight_report.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Trajectory trajectory_of(const FlightRun& run) {
  Trajectory trajectory;
  for (const FlightFrame& frame : run.frames) {
    trajectory.poses.push_back({frame.state.stamp_ns, std::nullopt});
    if (!frame.outcome) trajectory.poses.back().stamp_ns = frame.stamp_ns;
    if (frame.outcome) trajectory.poses.back().T_world_body = frame.state.T_world_body.isometry();
  }
  return trajectory;
}

/// What came of it.
struct Flown {
  FlightRun run;
  std::vector<BodyState> smoothed;
  std::optional<MarkerMap> map;
  json summary;
};

Flown fly(const FlightArguments& arguments, const Flight& flight) {
  const EurocBody& body = flight.body;
  Flown flown;
  const Stopwatch watch;
  {
    Progress progress("flight " + body.images->name(),
                      static_cast<std::int64_t>(body.images->size()));
    flown.run =
        run_flight(*body.images, flight.imu, body.T_body_cam, flight.layout, flight.options,
                   [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  }
  json& summary = flown.summary;
  summary = describe_flight(flown.run, body.images->stamp_ns(0));
  const auto frames = static_cast<double>(flown.run.frames.size());
  const double reading_ms = 1e3 * flown.run.stages.front().cpu_s / frames;
  summary["sequence"] = body.images->name();
  summary["reading_ms_per_frame"] = reading_ms;
  summary["cpu_ms_per_frame"] = watch.cpu_ms() / frames - reading_ms;
  if (!flight.truth.empty()) {
    summary["error"] = describe_error(flight.truth, estimated_states(flown.run));
    summary["drift"] = describe_drift(flight.truth, flown.run);
  }
  if (arguments.smooth) {
    const Stopwatch smoothing;
    flown.smoothed = smooth_flight(flown.run, flight.imu, body.T_body_cam, flight.options.flight);
    summary["smoother_cpu_ms_per_frame"] = smoothing.cpu_ms() / frames;
    if (!flight.truth.empty())
      summary["smoother"] = describe_smoother(flight.truth, flown.run, flown.smoothed);
  }
  if (arguments.map_markers) {
    flown.map = map_flight_markers(*body.images, flown.run, body.T_body_cam, flight.layout,
                                   flight.options.flight);
    summary["marker_map"] = describe_marker_map(*flown.map, flight.layout, flight.true_layout);
  }
  summary["peak_mb"] = peak_mb();
  return flown;
}

void write_results(const std::string& folder, const Flown& flown, const MarkerLayout& layout) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  for (const char* name : {"result.json", "smoothed.csv", "markers.yaml"})
    fs::remove(path(name));  // result.json is written last: its presence marks complete results
  write_trajectory(path("trajectory.tum"), trajectory_of(flown.run), TrajectoryFormat::kTum);
  write_body_states(path("states.csv"), estimated_states(flown.run));
  if (!flown.smoothed.empty()) write_body_states(path("smoothed.csv"), flown.smoothed);
  if (flown.map && flown.map->outcome)
    write_marker_layout(path("markers.yaml"), with_mapped(layout, *flown.map));
  write_file(path("frames.csv"), frames_csv(flown.run));
  write_file(path("result.json"), json_text(flown.summary, 1));
}

}  // namespace

FlightResult fly(const FlightArguments& arguments) {
  require_free_folder(arguments.out, arguments.force);
  const Flight flight = open_flight(arguments);
  const OutputFolder folder(arguments.out);
  const Flown flown = fly(arguments, flight);
  write_results(arguments.out, flown, flight.layout);
  FlightResult result{arguments.out, flown.summary, {}};
  if (estimated_states(flown.run).empty())
    result.no_result = arguments.flight + ": no image has a state (" +
                       flown.run.frames.back().outcome.reason + ")";
  else if (flown.map && !flown.map->outcome)
    result.no_result =
        arguments.flight + ": no marker was mapped (" + flown.map->outcome.reason + ")";
  return result;
}

std::string to_text(const FlightResult& result) {
  const json& summary = result.summary;
  std::string text =
      fmt::format("{}: {} of {} frames with a state, {} with flow, {} with markers\n",
                  summary["sequence"].get<std::string>(), summary["answered"].get<int>(),
                  summary["frames"].get<int>(), summary["frames_with_flow"].get<int>(),
                  summary["frames_with_markers"].get<int>());
  if (summary.contains("error") && summary["error"].contains("position_rmse_m")) {
    const json& error = summary["error"];
    text += fmt::format(
        "position RMSE {:.4f} m, velocity {:.4f} m/s, attitude {:.3f} deg over {:.1f} m\n",
        error["position_rmse_m"].get<double>(), error["velocity_rmse_mps"].get<double>(),
        error["attitude_rmse_deg"].get<double>(), error["path_length_m"].get<double>());
  }
  if (summary.contains("marker_map")) text += marker_map_line(summary["marker_map"]) + "\n";
  const double reading_ms = summary["reading_ms_per_frame"].get<double>();
  return text + fmt::format("{:.2f} ms CPU a frame ({:.2f} of them reading), results in {}\n",
                            summary["cpu_ms_per_frame"].get<double>() + reading_ms, reading_ms,
                            result.out);
}

std::string to_json(const FlightResult& result) { return json_text(result.summary, 1); }

std::string stages_text(const FlightResult& result) {
  const double frames = result.summary["frames"].get<double>();
  std::string text = fmt::format("{:<16} {:>9} {:>13}\n", "stage", "calls", "CPU ms/frame");
  for (const json& stage : result.summary["stages"])
    text +=
        fmt::format("{:<16} {:>9} {:>13.3f}\n", stage["name"].get<std::string>(),
                    stage["calls"].get<long long>(), 1e3 * stage["cpu_s"].get<double>() / frames);
  return text;
}

}  // namespace placegraph::apps
