#include "apps/saved_map/map_export.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/map_revisits.h>
#include <placegraph/graph/internal/pose_graph/rigid_graph.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/place_graph_export.h>
#include <placegraph/io/measurements/loop_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <functional>

#include "apps/results/map_file.h"
#include "apps/results/run_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// A form with its writer. A new form is one more entry here.
struct WrittenForm {
  MapExportForm form;
  bool needs_poses = false;  ///< rejected for a map without a camera
  /// Trajectories are those of the component with the given number.
  std::function<void(const std::string& path, const StoredMap& stored, int component)> write;
};

std::vector<WrittenForm> written_forms() {
  return {
      {{"--g2o", "the place graph"},
       true,
       [](const std::string& path, const StoredMap& stored, int) {
         write_g2o(path, stored.map.place_graph.pose_graph());
       }},
      {{"--g2o-se3", "the same without the scales of places, for programs without similarities"},
       true,
       [](const std::string& path, const StoredMap& stored, int) {
         write_g2o(path, rigid_graph(stored.map.place_graph.pose_graph()));
       }},
      {{"--places", "places, members, edges and loops as JSON"},
       false,
       [](const std::string& path, const StoredMap& stored, int) {
         write_file(path, places_json(stored.map));
       }},
      {{"--tum", "the optimized trajectory, TUM's form"},
       true,
       [](const std::string& path, const StoredMap& stored, int component) {
         write_trajectory(path, stored.map.trajectory_optimized(component), TrajectoryFormat::kTum);
       }},
      {{"--kitti", "the optimized trajectory, KITTI's form"},
       true,
       [](const std::string& path, const StoredMap& stored, int component) {
         write_trajectory(path, stored.map.trajectory_optimized(component),
                          TrajectoryFormat::kKitti);
       }},
      {{"--graphml", "the topological map: places, transitions, loops; GraphML"},
       true,
       [](const std::string& path, const StoredMap& stored, int) {
         write_file(path, to_graphml(stored.map.place_graph, place_transitions(stored.map)));
       }},
      {{"--dot", "the same for Graphviz"},
       true,
       [](const std::string& path, const StoredMap& stored, int) {
         write_file(path, to_dot(stored.map.place_graph, place_transitions(stored.map)));
       }},
      {{"--revisits", "the nearest older frame of every frame, for `placegraph eval loops`"},
       true,
       [](const std::string& path, const StoredMap& stored, int) {
         write_loop_predictions(path, map_revisits(stored.map));
       }}};
}

int component_of(const MapExportArguments& arguments, const Map& map) {
  if (!arguments.component) return map.main_component();
  std::string numbers;
  for (const MapComponent& component : map.components()) {
    if (component.number == *arguments.component) return component.number;
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(component.number);
  }
  throw ArgumentError(fmt::format("--component: {} has no component {}; it has {}", arguments.map,
                                  *arguments.component, numbers.empty() ? "none" : numbers));
}

}  // namespace

std::vector<MapExportForm> map_export_forms() {
  std::vector<MapExportForm> forms;
  for (const WrittenForm& written : written_forms()) forms.push_back(written.form);
  return forms;
}

MapExportResult map_export(const MapExportArguments& arguments) {
  const std::vector<WrittenForm> forms = written_forms();
  require(arguments.paths.size() == forms.size(), "map export: one path for each form is needed");
  require(std::any_of(arguments.paths.begin(), arguments.paths.end(),
                      [](const std::string& path) { return !path.empty(); }),
          "map export: nothing to write; see --help for the forms");
  for (const std::string& path : arguments.paths)
    if (!path.empty()) require_free(path, arguments.force);
  const StoredMap stored = read_stored_map(arguments.map);
  const int component = component_of(arguments, stored.map);
  MapExportResult result;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (arguments.paths[i].empty()) continue;
    if (forms[i].needs_poses && !stored.origin.calibration)
      throw NoResult(arguments.map +
                     ": a map of images without a camera has no poses to write to " +
                     arguments.paths[i]);
    forms[i].write(arguments.paths[i], stored, component);
    result.written.push_back(arguments.paths[i]);
  }
  return result;
}

}  // namespace placegraph::apps
