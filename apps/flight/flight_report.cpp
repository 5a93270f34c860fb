#include "apps/flight/flight_report.h"

#include <fmt/format.h>
#include <placegraph/eval/trajectory/body_state_error.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/text/csv_text.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace placegraph::apps {

using nlohmann::json;

namespace {

/// Times between accepted markers, from one second upwards.
std::vector<double> outages_of(const FlightRun& run) {
  std::vector<double> outages;
  std::int64_t last_ns = -1;
  for (const FlightFrame& frame : run.frames) {
    if (!frame.markers) continue;
    const double gap_s = 1e-9 * static_cast<double>(frame.stamp_ns - last_ns);
    if (last_ns >= 0 && gap_s >= 1) outages.push_back(gap_s);
    last_ns = frame.stamp_ns;
  }
  return outages;
}

}  // namespace

std::vector<BodyState> estimated_states(const FlightRun& run) {
  std::vector<BodyState> states;
  for (const FlightFrame& frame : run.frames)
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
          {"path_length_m", error.path_length_m},
          {"anees", number(error.anees)},
          {"anees_position", number(error.anees_position)},
          {"anees_velocity", number(error.anees_velocity)},
          {"anees_attitude", number(error.anees_attitude)}};
}

json describe_smoother(const std::vector<BodyState>& truth, const FlightRun& run,
                       const std::vector<BodyState>& smoothed) {
  json smoother = describe_error(truth, smoothed);
  std::vector<BodyState> filtered = estimated_states(run);
  std::erase_if(filtered, [&](const BodyState& state) {
    return smoothed.empty() || state.stamp_ns < smoothed.front().stamp_ns;
  });
  const BodyStateError filter = body_state_error(truth, filtered);
  if (filter.compared > 0 && smoother.contains("position_rmse_m"))
    smoother["filter_over_smoother"] =
        filter.position_rmse_m / smoother["position_rmse_m"].get<double>();
  return smoother;
}

json describe_drift(const std::vector<BodyState>& truth, const FlightRun& run) {
  std::vector<BodyState> since;
  for (const FlightFrame& frame : run.frames) {
    if (frame.markers) since.clear();
    if (frame.outcome) since.push_back(frame.state);
  }
  const BodyStateError error = body_state_error(truth, since);
  if (error.compared < 2) return nullptr;
  return {{"seconds", 1e-9 * static_cast<double>(since.back().stamp_ns - since.front().stamp_ns)},
          {"path_length_m", error.path_length_m},
          {"end_error_m", error.end_error_m},
          {"percent", 100 * error.end_error_m / error.path_length_m}};
}

json describe_flight(const FlightRun& run, std::int64_t first_ns) {
  json lost = json::array(), stages = json::array();
  int with_flow = 0, with_markers = 0;
  std::optional<double> start_s;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const FlightFrame& frame = run.frames[i];
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

std::string frames_csv(const FlightRun& run) {
  CsvText csv;
  csv.row("stamp_ns", "answered", "flow", "flow_points", "flow_chi2", "markers", "markers_seen",
          "sigma_x_m", "sigma_y_m", "sigma_z_m", "why");
  const auto flag = [](bool value) { return value ? 1 : 0; };
  for (const FlightFrame& frame : run.frames) {
    const Eigen::Vector3d sigma = frame.state.covariance.diagonal().head<3>().cwiseSqrt();
    csv.add(frame.stamp_ns).add(flag(static_cast<bool>(frame.outcome)));
    csv.add(flag(static_cast<bool>(frame.flow))).add(frame.flow_points);
    csv.add(fmt::format("{:.3f}", frame.flow_chi2)).add(flag(static_cast<bool>(frame.markers)));
    csv.add(frame.markers_seen);
    for (const double sigma_m : sigma) csv.add(fmt::format("{:.5f}", sigma_m));
    csv.row(frame.outcome ? "" : frame.outcome.reason);
  }
  return csv.text();
}

}  // namespace placegraph::apps
