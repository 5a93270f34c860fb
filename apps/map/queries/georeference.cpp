#include "apps/map/queries/georeference.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/geo_export.h>
#include <placegraph/io/sensors/oxts_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <unordered_map>

#include "apps/map/queries/georeference_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// Parses "x,y,z".
Eigen::Vector3d three_numbers(const std::string& flag, const std::string& text) {
  std::vector<std::string_view> fields;
  split_comma(text, fields);
  Eigen::Vector3d numbers;
  require(fields.size() == 3, flag + ": " + in_quotes(text) + " is not three numbers x,y,z");
  for (int i = 0; i < 3; ++i) {
    const auto number = parse_double(fields[static_cast<std::size_t>(i)]);
    require(number && std::isfinite(*number),
            flag + ": " + in_quotes(fields[static_cast<std::size_t>(i)]) + " is not a number");
    numbers[i] = *number;
  }
  return numbers;
}

GeoreferenceOptions options_of(const GeoreferenceArguments& arguments) {
  GeoreferenceOptions options;
  for (const std::string& setting : arguments.settings)
    set_option(options, setting, option_notes());
  if (arguments.lever_arm == "estimate") options.estimate_lever_arm = true;
  if (arguments.clock_offset == "estimate") options.estimate_clock_offset = true;
  options.check();
  return options;
}

void set_what_is_known(const GeoreferenceArguments& arguments, GeoreferenceInput& input) {
  if (!arguments.lever_arm.empty() && arguments.lever_arm != "estimate")
    input.lever_arm = three_numbers("--lever-arm", arguments.lever_arm);
  if (!arguments.origin.empty()) {
    const Eigen::Vector3d origin = three_numbers("--origin", arguments.origin);
    input.origin = {origin[0], origin[1], origin[2]};
    try {
      input.origin->check();
    } catch (const ArgumentError& error) {
      throw ArgumentError(std::string("--origin: ") + error.what());
    }
  }
  if (!arguments.clock_offset.empty() && arguments.clock_offset != "estimate") {
    const auto seconds = parse_double(arguments.clock_offset);
    require(seconds && std::abs(*seconds) < 4e9,
            "--clock-offset: " + in_quotes(arguments.clock_offset) + " is not a number of seconds");
    input.clock_offset_s = *seconds;
  }
}

/// Time of every placed node; the first one of several visits.
std::vector<std::int64_t> stamps_of(const PoseGraph& graph, const std::vector<NodeVisit>& visits) {
  std::unordered_map<NodeId, std::int64_t> first;
  for (const NodeVisit& visit : visits) {
    const auto [entry, fresh] = first.emplace(visit.node, visit.stamp_ns);
    if (!fresh) entry->second = std::min(entry->second, visit.stamp_ns);
  }
  std::vector<std::int64_t> stamps_ns;
  for (const PoseNode& node : graph.nodes) {
    const auto found = first.find(node.id);
    if (found == first.end()) return {};
    stamps_ns.push_back(found->second);
  }
  return stamps_ns;
}

void write_results(const std::string& folder, const GeoreferenceInput& input,
                   const GeoreferenceResult& result, const std::string& summary) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  fs::remove(path("georeference.json"));  // written last: its presence marks complete results
  GeoDocument document;
  document.name = fs::path(folder).lexically_normal().filename().string();
  document.origin = result.origin;
  document.trajectory = result.trajectory;
  document.graph = metric_graph(result.graph);
  document.node_stamps_ns = stamps_of(result.graph, input.visits);
  write_trajectory(path("trajectory_enu.tum"), result.trajectory, TrajectoryFormat::kTum);
  write_g2o(path("graph_enu.g2o"), document.graph);
  write_geojson(path("map.geojson"), document);
  write_kml(path("map.kml"), document);
  write_file(path("fixes.csv"), fixes_csv(result, input.fixes));
  write_file(path("georeference.json"), summary);
}

}  // namespace

GeoreferenceReport georeference(const GeoreferenceArguments& arguments) {
  const GeoreferenceOptions options = options_of(arguments);
  require_free_folder(arguments.out, arguments.force);
  GeoreferenceInput input = read_georeference_input(arguments.graph, arguments.times);
  set_what_is_known(arguments, input);
  input.fixes = read_oxts(arguments.gps);
  const OutputFolder folder(arguments.out);

  const std::clock_t begin = std::clock();
  GeoreferenceReport report{arguments.out, {}, {}};
  GeoreferenceResult& result = report.result;
  result = georeference(input, options, [](LogLevel level, const std::string& message) {
    if (level == LogLevel::kWarning) warn(message);
  });
  const double cpu_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (!result.outcome) throw NoResult(arguments.graph + ": " + result.outcome.reason);
  if (!result.unplaced_nodes.empty())
    warn(fmt::format("{} nodes are in components that the fixes do not place; they are left out",
                     result.unplaced_nodes.size()));

  report.summary = describe_georeference(result);
  report.summary["cpu_ms"] = cpu_ms;
  write_results(arguments.out, input, result, json_text(report.summary, 2));
  return report;
}

std::string to_text(const GeoreferenceReport& report) {
  const GeoreferenceResult& result = report.result;
  std::string text =
      fmt::format("origin       {:.9f}, {:.9f}, {:.3f} m (latitude, longitude, height)\n",
                  result.origin.latitude_deg, result.origin.longitude_deg, result.origin.height_m);
  if (const auto& scale = result.scale)
    text += fmt::format("scale        {:.5g} +- {:.2g} metres per unit, by the fixes\n",
                        scale->metres_per_unit, scale->sigma);
  text += fmt::format(
      "fixes        {} used, {} rejected, {} outside the map's time; residual {:.3f} m RMS\n",
      result.fixes_used, result.fixes_rejected,
      static_cast<int>(result.fixes.size()) - result.fixes_used - result.fixes_rejected,
      result.residual_rms_m);
  for (const GpsDropout& dropout : result.dropouts)
    text += fmt::format("dropout      {:.2f} s to {:.2f} s\n",
                        1e-9 * static_cast<double>(dropout.begin_ns),
                        1e-9 * static_cast<double>(dropout.end_ns));
  if (result.odometry_factor_translation != 1 || result.odometry_factor_rotation != 1)
    text += fmt::format(
        "odometry     dispersion {:.3g} (translation) and {:.3g} (rotation) times the stated one\n",
        result.odometry_factor_translation, result.odometry_factor_rotation);
  if (result.map_delay_s != 0)
    text += fmt::format("map delay    {:.4f} +- {:.4f} s, undone\n", result.map_delay_s,
                        result.map_delay_sigma_s);
  if (!result.lever_arm_covariance.isZero())
    for (int k = 0; k < 3; ++k)
      text += fmt::format("lever arm {}  {:.3f} +- {:.3f} m{}\n", "xyz"[k], result.lever_arm[k],
                          std::sqrt(result.lever_arm_covariance(k, k)),
                          result.lever_arm_observable[k] ? "" : " (hardly observable)");
  if (result.clock_offset_sigma_s > 0)
    text += fmt::format("clock offset {:.4f} +- {:.4f} s\n", result.clock_offset_s,
                        result.clock_offset_sigma_s);
  return text + fmt::format("{} nodes on the earth, written to {}\n", result.graph.nodes.size(),
                            report.out);
}

std::string to_json(const GeoreferenceReport& report) { return json_text(report.summary, 2); }

}  // namespace placegraph::apps
