#include "apps/map/cmd_georeference.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/geo_export.h>
#include <placegraph/io/sensors/oxts_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "apps/map/georeference_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

struct GeoreferenceArguments {
  std::string graph, gps, out, times, lever_arm, origin, clock_offset;
  std::vector<std::string> settings;
  bool as_json = false, force = false;
};

/// "a,b,c"
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
  for (const std::string& setting : arguments.settings) set_option(options, setting);
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

/// The times of the nodes that were placed; of several visits the first.
std::vector<std::int64_t> stamps_of(const PoseGraph& graph, const std::vector<NodeVisit>& visits) {
  std::unordered_map<std::int64_t, std::int64_t> first;
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
  fs::remove(path("georeference.json"));  // written last: it vouches for the others
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

void print_summary(const GeoreferenceResult& result, const std::string& folder) {
  fmt::print("origin       {:.9f}, {:.9f}, {:.3f} m (latitude, longitude, height)\n",
             result.origin.latitude_deg, result.origin.longitude_deg, result.origin.height_m);
  fmt::print("fixes        {} used, {} rejected, {} beside the map's time; residual {:.3f} m RMS\n",
             result.fixes_used, result.fixes_rejected,
             static_cast<int>(result.fixes.size()) - result.fixes_used - result.fixes_rejected,
             result.residual_rms_m);
  for (const GpsDropout& dropout : result.dropouts)
    fmt::print("dropout      {:.2f} s to {:.2f} s\n", 1e-9 * static_cast<double>(dropout.begin_ns),
               1e-9 * static_cast<double>(dropout.end_ns));
  if (result.odometry_factor_translation != 1 || result.odometry_factor_rotation != 1)
    fmt::print(
        "odometry     scatters {:.3g} (translation) and {:.3g} (rotation) times as claimed\n",
        result.odometry_factor_translation, result.odometry_factor_rotation);
  if (result.map_delay_s != 0)
    fmt::print("map delay    {:.4f} +- {:.4f} s, undone\n", result.map_delay_s,
               result.map_delay_sigma_s);
  if (!result.lever_arm_covariance.isZero())
    for (int k = 0; k < 3; ++k)
      fmt::print("lever arm {}  {:.3f} +- {:.3f} m{}\n", "xyz"[k], result.lever_arm[k],
                 std::sqrt(result.lever_arm_covariance(k, k)),
                 result.lever_arm_observable[k] ? "" : " (hardly observable)");
  if (result.clock_offset_sigma_s > 0)
    fmt::print("clock offset {:.4f} +- {:.4f} s\n", result.clock_offset_s,
               result.clock_offset_sigma_s);
  fmt::print("{} nodes on the earth, written to {}\n", result.graph.nodes.size(), folder);
}

void run(const GeoreferenceArguments& arguments) {
  const GeoreferenceOptions options = options_of(arguments);
  require_free_folder(arguments.out, arguments.force);
  GeoreferenceInput input = read_georeference_input(arguments.graph, arguments.times);
  set_what_is_known(arguments, input);
  input.fixes = read_oxts(arguments.gps);
  const OutputFolder folder(arguments.out);

  const std::clock_t begin = std::clock();
  const GeoreferenceResult result =
      georeference(input, options, [](LogLevel level, const std::string& message) {
        if (level == LogLevel::kWarning) warn(message);
      });
  const double cpu_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (!result.outcome) throw NoAnswer(arguments.graph + ": " + result.outcome.reason);
  if (!result.unplaced_nodes.empty())
    warn(fmt::format("{} nodes lie in components that the fixes do not place; they are left out",
                     result.unplaced_nodes.size()));

  nlohmann::ordered_json summary = describe_georeference(result);
  summary["cpu_ms"] = cpu_ms;
  write_results(arguments.out, input, result, summary.dump(2) + "\n");
  if (arguments.as_json)
    std::puts(summary.dump(2).c_str());
  else
    print_summary(result, arguments.out);
}

}  // namespace

void add_georeference_command(CLI::App& app) {
  auto arguments = std::make_shared<GeoreferenceArguments>();
  GeoreferenceArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("georeference", "Put a map onto the earth by GPS");
  command->footer(
      "placegraph georeference out/run --gps 2011_09_26_drive_0095_sync --out out/earth");
  command
      ->add_option("GRAPH", a.graph,
                   "output folder of `placegraph run`, or a .g2o graph with --times")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("--gps", a.gps,
                   "OXTS: folder of KITTI raw, or oxts.txt beside its times_oxts.txt")
      ->required();
  command->add_option("--out", a.out, "folder for the results")->required();
  command->add_option("--times", a.times,
                      "times of a .g2o graph's nodes: line i (from 0) of node i [s]");
  command->add_option("--lever-arm", a.lever_arm,
                      "antenna in the nodes' frame, x,y,z [m] (camera: right, down, forward), or "
                      "estimate; default 0,0,0");
  command->add_option(
      "--origin", a.origin,
      "of the east-north-up frame: latitude,longitude,height [deg, m]; default: the "
      "median of the fixes");
  command->add_option("--clock-offset", a.clock_offset,
                      "seconds to add to the times of the fixes, or estimate; default 0");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "print georeference.json");
  command->add_flag("--force", a.force, "write into a folder that is not empty");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
