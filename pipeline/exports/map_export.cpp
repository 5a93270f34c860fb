#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map_revisits.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/datasets/distinct_paths.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/place_graph_export.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/exports/colmap_export.h>
#include <placegraph/pipeline/exports/dense_export.h>
#include <placegraph/pipeline/exports/gltf_export.h>
#include <placegraph/pipeline/exports/keyframe_frames.h>
#include <placegraph/pipeline/exports/map_export.h>
#include <placegraph/pipeline/exports/mcap_export.h>
#include <placegraph/pipeline/exports/nerf_export.h>
#include <placegraph/pipeline/exports/occupancy_export.h>
#include <placegraph/pipeline/exports/place_tables.h>
#include <placegraph/pipeline/exports/ply_export.h>
#include <placegraph/pipeline/map/map_file.h>

#include <algorithm>
#include <filesystem>
#include <functional>

namespace placegraph {
namespace {

/// The map, and what of it is written how.
struct MapExportInput {
  const StoredMap& stored;
  int component = 0;              ///< number of the component
  NumberForm numbers{};           ///< form of the numbers where there is a choice
  double cell_m = 0.05;           ///< side of a cell of an occupancy grid
  FloorPlanner floor_plan{};      ///< makes the floor plan whose walls a grid shows; empty: none
  std::string undistorted{};      ///< folder for the undistorted images; empty: none
  DenseOutputs* dense = nullptr;  ///< cloud and mesh, which are made at once
  const LogSink& log;             ///< receiver of warnings
};

/// A form with its writer. A new form is one more entry in one of the two tables.
struct WrittenForm {
  MapExportForm form;
  bool needs_poses = false;  ///< rejected for a map without a camera
  std::function<void(const std::string& path, const MapExportInput& input, MapExportResult& result)>
      write;
};

/// Graphs, trajectories and places.
std::vector<WrittenForm> graph_forms() {
  const auto trajectory = [](TrajectoryFormat format) {
    return [format](const std::string& path, const MapExportInput& input, MapExportResult&) {
      write_trajectory(path, input.stored.map.trajectory_optimized(input.component), format);
    };
  };
  const auto text = [](std::string (*text_of)(const Map& map)) {
    return [text_of](const std::string& path, const MapExportInput& input, MapExportResult&) {
      write_file(path, text_of(input.stored.map));
    };
  };
  return {
      {{"--g2o", "the place graph"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_g2o(path, input.stored.map.place_graph.pose_graph());
       }},
      {{"--g2o-se3", "the same without the scales of places, for programs without similarities"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_g2o(path, rigid_graph(input.stored.map.place_graph.pose_graph()));
       }},
      {{"--places", "places, members, edges and loops as JSON"}, false, text(places_json)},
      {{"--tum", "the optimized trajectory, TUM's form"}, true, trajectory(TrajectoryFormat::kTum)},
      {{"--kitti", "the optimized trajectory, KITTI's form"},
       true,
       trajectory(TrajectoryFormat::kKitti)},
      {{"--graphml", "the topological map: places, transitions, loops; GraphML"},
       true,
       text([](const Map& map) { return to_graphml(map.place_graph, place_transitions(map)); })},
      {{"--dot", "the same for Graphviz"}, true, text([](const Map& map) {
         return to_dot(map.place_graph, place_transitions(map));
       })},
      {{"--revisits", "the nearest older frame of every frame, for `placegraph eval loops`"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_loop_predictions(path, map_revisits(input.stored.map));
       }}};
}

/// Landmarks and keyframes.
std::vector<WrittenForm> geometry_forms() {
  return {
      {{"--ply", "the landmarks with colours and standard deviations, PLY"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_file(path, landmarks_ply(input.stored, input.component, input.numbers));
       }},
      {{"--colmap", "keyframes and landmarks after a bundle adjustment, COLMAP's model",
        MapExportTarget::kFolder},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult& result) {
         result.colmap = write_colmap(path, input.stored, input.component, input.numbers,
                                      input.undistorted, input.log);
       }},
      {{"--nerf", "the keyframes for radiance fields, transforms.json"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_file(path, nerf_transforms(path, input.stored, input.component, input.undistorted,
                                          input.log));
       }},
      {{"--undistorted",
        "the images of the keyframes without distortion, which --colmap and --nerf then name",
        MapExportTarget::kFolder},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_undistorted(path, input.stored, input.component);
       }},
      {{"--occupancy", "an occupancy grid as map_server of ROS reads it", MapExportTarget::kImage},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_occupancy(path, input.stored, input.component, input.cell_m, input.floor_plan,
                         input.log);
       }},
      {{"--gltf", "trajectory, landmarks and keyframes for 3D viewers, .glb or .gltf"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         const GltfForm form = extension_of(path) == ".glb" ? GltfForm::kGlb : GltfForm::kGltf;
         write_file(path, map_gltf(input.stored, input.component, form));
       }},
      {{"--mcap", "trajectory and landmarks as messages of Foxglove's types, MCAP"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         write_file(path, map_mcap(input.stored, input.component));
       }},
      {{"--cloud", "the dense cloud of the surfaces in the images, PLY"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         input.dense->cloud = path;
       }},
      {{"--mesh", "the surfaces in the images as triangles, .ply or .glb"},
       true,
       [](const std::string& path, const MapExportInput& input, MapExportResult&) {
         input.dense->mesh = path;
       }}};
}

std::vector<WrittenForm> written_forms() {
  std::vector<WrittenForm> forms = graph_forms();
  for (WrittenForm& form : geometry_forms()) forms.push_back(std::move(form));
  return forms;
}

/// Checks that a form can be written to a path.
void require_free_target(const MapExportForm& form, const std::string& path, bool force) {
  switch (form.target) {
    case MapExportTarget::kFile:
      require_free(path, force);
      break;
    case MapExportTarget::kFolder:
      require_free_folder(path, force);
      break;
    case MapExportTarget::kImage:
      require_free(path + ".pgm", force);
      require_free(path + ".yaml", force);
      break;
  }
  require(form.flag != "--gltf" || extension_of(path) == ".glb" || extension_of(path) == ".gltf",
          "--gltf: " + path + ": the extension is .glb or .gltf");
  require(form.flag != "--mesh" || extension_of(path) == ".ply" || extension_of(path) == ".glb",
          "--mesh: " + path + ": the extension is .ply or .glb");
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

/// Checks that something is to be written, and can be, before the work for it.
void require_free_targets(const std::vector<WrittenForm>& forms,
                          const MapExportArguments& arguments) {
  require(arguments.paths.size() == forms.size(), "map export: one path for each form is needed");
  require(std::any_of(arguments.paths.begin(), arguments.paths.end(),
                      [](const std::string& path) { return !path.empty(); }),
          "map export: nothing to write; see --help for the forms");
  std::vector<NamedPath> targets;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (arguments.paths[i].empty()) continue;
    const bool image = forms[i].form.target == MapExportTarget::kImage;
    for (const char* extension : image ? std::vector{".pgm", ".yaml"} : std::vector{""})
      targets.push_back({forms[i].form.flag, arguments.paths[i] + extension});
    require_free_target(forms[i].form, arguments.paths[i], arguments.force);
  }
  require(!arguments.walls || arguments.floor_plan != nullptr,
          "--walls: nothing here makes floor plans, which is placegraph::elements' work");
  require_distinct_paths(targets, {{"MAP", arguments.map}});
}

}  // namespace

std::vector<MapExportForm> map_export_forms() {
  std::vector<MapExportForm> forms;
  for (const WrittenForm& written : written_forms()) forms.push_back(written.form);
  return forms;
}

MapExportResult map_export(const MapExportArguments& arguments, const MapExportMessages& messages) {
  require_free_targets(written_forms(), arguments);
  return map_export(read_stored_map(arguments.map, messages.log), arguments, messages);
}

MapExportResult map_export(const StoredMap& stored, const MapExportArguments& arguments,
                           const MapExportMessages& messages) {
  const std::vector<WrittenForm> forms = written_forms();
  require_free_targets(forms, arguments);
  const NumberForm numbers = arguments.ascii ? NumberForm::kText : NumberForm::kBinary;
  DenseOutputs dense{"", "", arguments.voxel, numbers};
  MapExportInput input{.stored = stored,
                       .component = component_of(arguments, stored.map),
                       .numbers = numbers,
                       .cell_m = arguments.resolution_m,
                       .floor_plan = arguments.walls ? arguments.floor_plan : FloorPlanner(),
                       .undistorted = {},
                       .dense = &dense,
                       .log = messages.log};
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (forms[i].form.flag == "--undistorted") input.undistorted = arguments.paths[i];
  MapExportResult result;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (arguments.paths[i].empty()) continue;
    if (forms[i].needs_poses && !stored.origin.calibration)
      throw NoResult(arguments.map +
                     ": a map of images without a camera has no poses to write to " +
                     arguments.paths[i]);
    forms[i].write(arguments.paths[i], input, result);
    result.written.push_back(arguments.paths[i]);
  }
  if (!dense.cloud.empty() || !dense.mesh.empty())
    result.dense = write_dense(dense, stored, input.component, messages.progress);
  return result;
}

std::string to_text(const MapExportResult& result) {
  return (result.colmap ? to_text(*result.colmap) : "") +
         (result.dense ? to_text(*result.dense) : "");
}

}  // namespace placegraph
