#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/exports/occupancy_export.h>
#include <placegraph/pipeline/map/map_occupancy.h>

#include <filesystem>

namespace placegraph {
namespace {

/// The floor plan of a map; nothing, with a warning, if it has none.
std::optional<FloorPlan> floor_plan_of(const std::string& base, const StoredMap& stored,
                                       const FloorPlanner& floor_plan, const LogSink& log_sink) {
  FloorPlan plan = floor_plan(stored);
  if (plan.outcome) return plan;
  log(log_sink, LogLevel::kWarning, "{}: without walls, there is no floor plan: {}", base,
      plan.outcome.reason);
  return std::nullopt;
}

}  // namespace

void write_occupancy(const std::string& base, const StoredMap& stored, int component, double cell_m,
                     const FloorPlanner& floor_plan, const LogSink& log_sink) {
  require(!floor_plan || component == stored.map.main_component(),
          "--walls: the floor plan is that of the main component");
  std::optional<FloorPlan> plan;
  if (floor_plan && stored.map.metric) plan = floor_plan_of(base, stored, floor_plan, log_sink);
  MapOccupancyOptions options;
  options.cell_m = cell_m;
  const MapOccupancy occupancy =
      occupancy_of(stored.map, component, options, plan ? &*plan : nullptr);
  if (!occupancy.outcome) throw NoResult(base + ": no occupancy grid: " + occupancy.outcome.reason);
  const std::string image = base + ".pgm";
  write_file(image, to_pgm(occupancy.grid));
  write_file(base + ".yaml",
             to_map_server_yaml(occupancy.grid, std::filesystem::path(image).filename().string()));
}

}  // namespace placegraph
